-- Links of the documents for pandoc: a link to page.md becomes one to page.html, and one that
-- leaves resources/doc, to a schema, becomes one to the copy beside the pages. With the variable
-- `single` all pages of the manual stand in one file: a link to one becomes its anchor, and one to
-- another document becomes its words.
local single = PANDOC_WRITER_OPTIONS.variables.single
local depth = tonumber(tostring(PANDOC_WRITER_OPTIONS.variables.depth or 0))

local function Escapes(target)
  local levels = 0
  while target:sub(1, 3) == "../" do
    target, levels = target:sub(4), levels + 1
  end
  return levels > depth, target
end

function Link(link)
  local target = link.target
  if target:find("://") or target:sub(1, 1) == "#" then return nil end
  if single and target:sub(1, 3) == "../" then return link.content end
  local leaves, rest = Escapes(target)
  if leaves then
    link.target = string.rep("../", depth) .. rest
    return link
  end
  local page, anchor = target:match("([%w_-]+)%.md#?(.*)$")
  if page == nil then return nil end
  if single then
    link.target = "#" .. page .. (anchor ~= "" and "-" .. anchor or "")
  else
    link.target = target:gsub("%.md", ".html", 1)
  end
  return link
end
