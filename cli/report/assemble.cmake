# Joins a page into one file, and writes that as the bytes of a C array.
# cmake -DSOURCE=folder of the page -DHTML=its frame, a file there -DSCRIPTS=name;... -DTHREE=bundle or empty -DTHREE_LICENCE=file or empty
#       -DPAGE=page.html -DBYTES=page.inc -P assemble.cmake
cmake_minimum_required(VERSION 3.25)  # else @NAME@ would stand for a variable

file(READ "${SOURCE}/${HTML}" page)
file(READ "${SOURCE}/style.css" style)
set(script "")
foreach(name IN LISTS SCRIPTS)
  file(READ "${SOURCE}/${name}" text)
  string(APPEND script "${text}")
endforeach()
set(three "")
set(licence "")
if(THREE)
  file(READ "${THREE}" three)
  file(READ "${THREE_LICENCE}" licence)
endif()
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@LICENCE@" "${licence}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
string(REPLACE "@THREE@" "${three}" page "${page}")
file(WRITE "${PAGE}" "${page}")
file(READ "${PAGE}" bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file(WRITE "${BYTES}" "${bytes}\n")
