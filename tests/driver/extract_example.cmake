# cmake -DGUIDE=<guide> -DNAME=<name> -DOUT=<file> -P extract_example.cmake
# Writes the code block behind the line `<!-- example: NAME -->` of the guide.
file(READ ${GUIDE} guide)
string(FIND "${guide}" "<!-- example: ${NAME} -->\n\n```c\n" start)
if(start EQUAL -1)
  message(FATAL_ERROR "${GUIDE}: no code block behind <!-- example: ${NAME} -->")
endif()
string(LENGTH "<!-- example: ${NAME} -->\n\n```c\n" marker)
math(EXPR start "${start} + ${marker}")
string(SUBSTRING "${guide}" ${start} -1 rest)
string(FIND "${rest}" "\n```" end)
string(SUBSTRING "${rest}" 0 ${end} code)
file(WRITE ${OUT} "${code}\n")
