# Writes HEADER: the words of the SPIR-V file MODULE as the constexpr array SYMBOL.
file(READ ${MODULE} hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1u," words "${hex}")
file(WRITE ${HEADER} "#pragma once\n#include <cstdint>\ninline constexpr uint32_t ${SYMBOL}[] = {${words}};\n")
