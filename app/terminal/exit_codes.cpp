#include "app/terminal/exit_codes.h"

#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "app/terminal/style.h"
#include "core/error.h"

namespace vitrel {
int complain(const std::string& program, const std::string& message, int code) {
  std::cerr << styled(program + ":", Style::error, STDERR_FILENO) << ' ' << visible(message)
            << '\n';
  return code;
}

int exit_code_of(const std::string& program, const std::function<int()>& work) {
  try {
    return work();
  } catch (const UserError& error) {
    return complain(program, error.what(), user_error);
  } catch (const FileError& error) {
    return complain(program, error.what(), file_error);
  } catch (const InvariantError& error) {
    return complain(program, error.what(), broken_invariant);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(program, error.path1().string() + ": " + error.code().message(), file_error);
  } catch (const std::system_error& error) {
    return complain(program, error.what(), file_error);
  } catch (const std::bad_alloc&) {
    return complain(program,
                    "out of memory; fewer particles or a smaller analysis.memory need less",
                    user_error);
  } catch (const std::exception& error) {
    return complain(program,
                    std::string("a defect of the program (") + error.what() +
                        "); please report it with the command and its files",
                    defect);
  }
}

}  // namespace vitrel
