#pragma once

/// The program `vitrel`, which its main() calls. In packages, main() calls it in a shared library.
extern "C" [[gnu::visibility("default")]] int vitrel_main(int count, char** words);
