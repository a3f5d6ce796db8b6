#include "app/program.h"

int main(int count, char** words) {
  return vitrel_main(count, words);
}
