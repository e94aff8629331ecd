// Files of a folder with their bytes, compared and put back by the trials.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace arthro::test {

using Files = std::map<std::string, std::string>;  // name below the folder -> bytes

Files FilesIn(const std::filesystem::path& folder);
void Clear(const std::filesystem::path& folder);
void Restore(const std::filesystem::path& folder, const Files& files);
// Sets times of change back by some hours: a young file may belong to a process of another machine.
void MakeOld(const std::filesystem::path& folder);

// Reports and results hold times, so that no two are alike: what they hold instead is compared.
bool IsSame(const std::string& name, const std::string& a, const std::string& b);

}  // namespace arthro::test
