#include "workflow/picture/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/io/checked.h"

namespace vitrel {
namespace {

/// Starts a program of PATH; returns the number of the error, or 0.
int start(std::vector<std::string> words, pid_t& process) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ);
}

}  // namespace

Film::Film(const std::filesystem::path& path, int width, int height, double images_per_second)
    : path_(path), pending_(path) {
  std::array<int, 2> ends{};
  checked(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), "socketpair");
  checked(fcntl(ends[0], F_SETFD, FD_CLOEXEC), "fcntl");
  input_ = ends[0];
  // Players ask for colours of the form yuv420p.
  const int error = start({"ffmpeg",
                           "-nostdin",
                           "-loglevel",
                           "error",
                           "-y",
                           "-f",
                           "rawvideo",
                           "-pixel_format",
                           "rgb24",
                           "-video_size",
                           fmt::format("{}x{}", width, height),
                           "-framerate",
                           fmt::format("{}", images_per_second),
                           "-i",
                           fmt::format("pipe:{}", ends[1]),
                           "-pix_fmt",
                           "yuv420p",
                           "-f",
                           "mp4",
                           "file:" + pending_.partial().string()},
                          process_);
  static_cast<void>(::close(ends[1]));
  if (error == 0) return;
  static_cast<void>(::close(ends[0]));
  throw UserError(fmt::format(
      "films are made by the program ffmpeg, which cannot be started: {}; install it, or write a "
      "picture (.png)",
      std::generic_category().message(error)));
}

Film::~Film() {
  if (process_ == 0) return;
  static_cast<void>(kill(process_, SIGKILL));
  static_cast<void>(end_input());
}

/// Returns what waitpid says.
int Film::end_input() {
  static_cast<void>(::close(input_));
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
  return status;
}

void Film::add(const Image& image) {
  for (std::size_t sent = 0; sent < image.pixels.size();) {
    const ssize_t part =
        send(input_, &image.pixels[sent], image.pixels.size() - sent, MSG_NOSIGNAL);
    if (part < 0 && errno != EINTR) fail(end_input());
    sent += static_cast<std::size_t>(std::max<ssize_t>(part, 0));
  }
}

void Film::close() {
  if (const int status = end_input(); status != 0) fail(status);
  pending_.commit();
}

void Film::fail(int status) const {
  throw FileError(fmt::format(
      "{}: cannot be written: ffmpeg {} {}", path_.string(),
      WIFSIGNALED(status) ? "was ended by the signal" : "ended early with the exit code",
      WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
}

}  // namespace vitrel
