#pragma once

/// The program `vitrel`, called by its main(); in packages across the border of a shared library.
extern "C" [[gnu::visibility("default")]] int vitrel_main(int count, char** words);
