#include "app/program.h"

#include "app/commands/commands.h"

int vitrel_main(int count, char** words) {
  return vitrel::run_command_line(count, words);
}
