# Writes OUTPUT: a line {"NAME", R"glsl(TEXT)glsl"}, for each of FILES (separated by commas). Comments
# are left out, since some drivers take ASCII only.
string(REPLACE "," ";" files "${FILES}")
set(table "")
foreach(file IN LISTS files)
  file(READ "${FOLDER}/${file}" text)
  string(REGEX REPLACE "[ ]*//[^\n]*" "" text "${text}")
  string(APPEND table "{\"${file}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "${table}")
