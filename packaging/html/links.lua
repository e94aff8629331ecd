-- Links of the documents for pandoc: a link to page.md becomes one to page.html, and one that
-- leaves resources/doc, to a schema, becomes one to the copy beside the pages. A link to any other
-- file of the sources becomes its words. With the variable `single`, the name of the page, all pages
-- stand in one file: headings get the name before their anchors, a link to a page becomes its
-- anchor, and one to a schema its words.
local single = PANDOC_WRITER_OPTIONS.variables.single and tostring(PANDOC_WRITER_OPTIONS.variables.single)
local depth = tonumber(tostring(PANDOC_WRITER_OPTIONS.variables.depth or 0))

-- Levels that a target goes up, and the rest of it.
local function Climb(target)
  local levels = 0
  while target:sub(1, 3) == "../" do
    target, levels = target:sub(4), levels + 1
  end
  return levels, target
end

function Header(header)
  if not single then return nil end
  header.identifier = single .. "-" .. header.identifier
  return header
end

function Link(link)
  local target = link.target
  if target:find("://") then return nil end
  if target:sub(1, 1) == "#" then
    if single then link.target = "#" .. single .. "-" .. target:sub(2) end
    return link
  end
  local levels, rest = Climb(target)
  if levels > depth then
    if single or rest:sub(1, 8) ~= "schemas/" then return link.content end
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
