# Writes HEADER: the bytes of the file TEXT as the string_view SYMBOL. Bytes, not a raw string: any text is allowed in it.
file(READ ${TEXT} hex HEX)
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
file(WRITE ${HEADER}
  "#pragma once\n#include <string_view>\n"
  "inline constexpr char ${SYMBOL}_bytes[] = {${bytes}'\\0'};\n"
  "inline constexpr std::string_view ${SYMBOL}{${SYMBOL}_bytes, sizeof(${SYMBOL}_bytes) - 1};\n")
