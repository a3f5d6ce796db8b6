#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/io/checked.h"
#include "core/io/checkpoint.h"
#include "core/io/h5md.h"
#include "core/io/transactional_file.h"
#include "tests/support/files.h"
#include "tests/support/stored_frames.h"

/// Every system call that changes a file is counted; at a chosen one the process ends at once, as if
/// killed, or the disk is full from then on. At two of them it stops until it is told to go on.
namespace {

enum class Fault { none, kill, full_disk, stop, unreadable };
Fault fault = Fault::none;
long calls_before_fault = 0;
long calls_between_stops = 0;

void stop_at_two_calls() {
  if (fault != Fault::stop || calls_before_fault-- > 0) return;
  static_cast<void>(raise(SIGSTOP));
  if (calls_between_stops == 0) fault = Fault::none;
  calls_before_fault = std::exchange(calls_between_stops, 0) - 1;
}

bool fault_strikes() {
  stop_at_two_calls();
  return (fault == Fault::kill || fault == Fault::full_disk) && calls_before_fault-- <= 0;
}

}  // namespace

// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the C library's are reserved
extern "C" ssize_t pwrite(int descriptor, const void* data, size_t size, off_t offset) {
  if (fault_strikes()) {
    if (fault == Fault::kill) {
      static_cast<void>(syscall(SYS_pwrite64, descriptor, data, size / 2, offset));  // a torn write
      _exit(9);
    }
    errno = ENOSPC;
    return -1;
  }
  return syscall(SYS_pwrite64, descriptor, data, size, offset);
}

// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" int ftruncate(int descriptor, off_t size) noexcept {
  if (fault != Fault::full_disk && fault_strikes()) _exit(9);
  return static_cast<int>(syscall(SYS_ftruncate, descriptor, size));
}

// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" ssize_t pread(int descriptor, void* data, size_t size, off_t offset) {
  if (fault == Fault::unreadable && calls_before_fault-- <= 0) {
    errno = EIO;
    return -1;
  }
  return syscall(SYS_pread64, descriptor, data, size, offset);
}

namespace vitrel {
namespace {

namespace fs = std::filesystem;

class Interrupted : public Files {
 protected:
  Interrupted() {
    void* shared =
        mmap(nullptr, sizeof(long), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    completed_ = static_cast<long*>(shared);
  }
  ~Interrupted() override { static_cast<void>(munmap(completed_, sizeof(long))); }

  /// Runs `work` in a process of its own in which `kind` strikes at the given call. True if the
  /// process ended by the fault; a process that was not killed must end in order and in silence.
  template <class Work>
  bool struck(Fault kind, long call, Work&& work) {
    *completed_ = 0;
    const pid_t child = fork();
    if (child == 0) {
      if (!freopen(file("messages").c_str(), "w", stderr)) _exit(1);
      fault = kind;
      calls_before_fault = call;
      try {
        work();
      } catch (const FileError& error) {
        std::exit(
            std::string(error.what()).find("No space left on device") == std::string::npos ? 2 : 9);
      }
      std::exit(0);  // with the exit handlers of HDF5
    }
    int status = 0;
    checked(waitpid(child, &status, 0), "waitpid");
    EXPECT_TRUE(WIFEXITED(status)) << "crashed, call " << call;
    EXPECT_TRUE(WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 9) << "call " << call;
    EXPECT_EQ(fs::file_size(file("messages")), 0u) << "call " << call;
    return WEXITSTATUS(status) == 9;
  }

  long* completed_;  ///< counted by the child, read by the parent
};

Configuration2 frame(std::uint64_t k) {
  Configuration2 configuration;
  configuration.resize(3);
  configuration.species_names = {"A"};
  configuration.box = PeriodicBox<2>(Vec2(10, 8));
  configuration.time = std::sqrt(k);
  for (std::size_t i = 0; i < 3; ++i) {
    configuration.position[i] = {std::sin(k + i), std::cos(k - 2.0 * i)};
    configuration.angle[i] = std::sqrt(k + 7.0 * i);
  }
  return configuration;
}

void expect_frame(const TrajectoryReader& reader, std::uint64_t k) {
  const Configuration2 read = reader.read(k), right = frame(k);
  EXPECT_EQ(read.time, right.time);
  EXPECT_EQ(read.position, right.position);
  EXPECT_EQ(read.angle, right.angle);
  EXPECT_EQ(reader.steps()[k], static_cast<std::int64_t>(k));
}

/// The frames that matter: the first, and those around the interruption.
void expect_frames_from(const fs::path& path, std::uint64_t frames, std::uint64_t from) {
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.frames(), frames);
  expect_frame(reader, 0);
  for (std::uint64_t k = from; k < frames; ++k) expect_frame(reader, k);
}

constexpr std::uint64_t first = 62,
                        frames = 5;  // HDF5's index nodes hold 64 entries and split here

class InterruptedTrajectory : public Interrupted {
 protected:
  InterruptedTrajectory() {
    auto writer = TrajectoryWriter::create(file("start.h5"), frame(0), Provenance());
    for (std::uint64_t k = 0; k < first + 2; ++k) writer.write(frame(k), k);
  }
  /// Strikes at each single write of a run that drops two frames, then adds some. No frame that was
  /// complete is lost, no other frame appears, and the file can be read at once; `examine` gets the
  /// number of its frames.
  template <class Examine>
  void strike_at_every_write(Fault kind, Examine&& examine) {
    long call = 0;
    for (;; ++call) {
      start_again();
      if (!struck(kind, call, [&] { drop_and_add_frames(); })) break;
      const std::uint64_t found = TrajectoryReader(run_).frames();
      if (*completed_ == 0 && found == first + 2) continue;  // before the two frames were dropped
      EXPECT_GE(found, first + *completed_) << "call " << call;
      EXPECT_LE(found, first + *completed_ + 1) << "call " << call;
      expect_frames_from(run_, found, first - 1);  // as the reader sees it, with the journal
      examine(found);
      if (HasFailure()) return;
    }
    EXPECT_GT(call, 50);
  }
  void drop_and_add_frames() {
    auto writer = TrajectoryWriter::append_to(run_, first);
    for (std::uint64_t k = first; k < first + frames; ++k) {
      writer.write(frame(k), k);
      writer.commit();
      ++*completed_;
    }
    writer.close();
  }
  void start_again() {
    fs::copy_file(file("start.h5"), run_, fs::copy_options::overwrite_existing);
  }

  const fs::path run_ = file("run.h5");
};

TEST_F(InterruptedTrajectory, KilledAtEveryWrite) {
  strike_at_every_write(Fault::kill, [&](std::uint64_t found) {
    TrajectoryWriter::append_to(run_, found);
    expect_frames_from(run_, found, first - 1);  // repaired
  });
  drop_and_add_frames();
  expect_frames_from(run_, first + frames, 0);
}

TEST_F(InterruptedTrajectory, DiskFullAtEveryWrite) {
  strike_at_every_write(Fault::full_disk, [](std::uint64_t) {});
}

/// Another process adds frames, and stops at two of the calls that change the file.
class TrajectoryBeingWritten : public InterruptedTrajectory {
 protected:
  ~TrajectoryBeingWritten() override {
    if (child_ == 0) return;
    static_cast<void>(kill(child_, SIGKILL));
    static_cast<void>(waitpid(child_, nullptr, 0));
  }

  bool start(long first_call, long calls_between) {
    start_again();
    child_ = fork();
    if (child_ != 0) return is_stopped();
    fault = Fault::stop;
    calls_before_fault = first_call;
    calls_between_stops = calls_between;
    auto writer = TrajectoryWriter::append_to(run_, first + 2);
    for (std::uint64_t k = first + 2; k < first + 2 + frames; ++k) {
      writer.write(frame(k), k);
      writer.commit();
    }
    writer.close();
    _exit(0);
  }
  /// To the second stop, or to the end.
  void go_on() {
    if (child_ == 0) return;
    checked(kill(child_, SIGCONT), "kill");
    is_stopped();
  }

 private:
  bool is_stopped() {
    int status = 0;
    checked(waitpid(child_, &status, WUNTRACED), "waitpid");
    if (WIFSTOPPED(status)) return true;
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    child_ = 0;
    return false;
  }
  pid_t child_ = 0;
};

// Opened at each single write, and read again at later ones.
TEST_F(TrajectoryBeingWritten, IsReadAsItWasAtOneCommit) {
  long opened = 0;
  for (const long later : {1, 4, 11, 1000}) {
    for (long call = 1; start(call, later); ++call, ++opened) {
      const TrajectoryReader reader(run_);
      const std::uint64_t found = reader.frames();
      EXPECT_GE(found, first + 2);
      EXPECT_EQ(reader.import_report().size(), 1u);
      expect_frame(reader, found - 1);
      go_on();
      for (std::uint64_t k = first; k < found; ++k) expect_frame(reader, k);
      expect_frame(reader, 0);
      EXPECT_EQ(reader.frames(), found);
      go_on();
      if (HasFailure()) FAIL() << "call " << call << ", then " << later;
    }
  }
  EXPECT_GT(opened, 200);
}

// The copy has its first bytes of one moment, and the others of a later one.
TEST_F(TrajectoryBeingWritten, ASlowCopyHasFramesOfOneCommitOrIsRefused) {
  int whole = 0, refused = 0;
  for (const double part : {0.01, 0.2, 0.6, 0.95}) {
    for (const long later : {1, 8, 30}) {
      for (long call = 0; start(call, later); call += 3) {
        const std::string before = contents(run_);
        const auto begin = static_cast<std::size_t>(part * static_cast<double>(before.size()));
        go_on();
        const std::string after = contents(run_);
        overwrite(file("copy.h5"),
                  before.substr(0, begin) + after.substr(std::min(begin, after.size())));
        try {
          const TrajectoryReader reader(file("copy.h5"));
          EXPECT_GE(reader.frames(), first + 2);
          EXPECT_LE(reader.frames(), first + 2 + frames);
          for (std::uint64_t k = 0; k < reader.frames(); ++k) expect_frame(reader, k);
          ++whole;
        } catch (const FileError& error) {
          EXPECT_NE(std::string(error.what()).find("copied while another process wrote it"),
                    std::string::npos)
              << error.what();
          ++refused;
        }
        go_on();
        if (HasFailure()) FAIL() << "call " << call << ", then " << later << ", part " << part;
      }
    }
  }
  EXPECT_GT(whole, 100);
  EXPECT_GT(refused, 100);
}

// Else a reader would take a run that has just begun for one that has ended without a frame.
TEST_F(InterruptedTrajectory, IsLockedFromTheMomentThatItIsSeen) {
  for (int k = 0; k < 10; ++k) {
    const std::string path = file("run" + std::to_string(k) + ".h5");
    bool was_locked = false;
    std::thread watcher([&] {
      int descriptor = -1;
      while (descriptor < 0) descriptor = ::open(path.c_str(), O_RDONLY);
      was_locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
      static_cast<void>(::close(descriptor));
    });
    const auto writer = TrajectoryWriter::create(path, frame(0), Provenance());
    watcher.join();
    EXPECT_TRUE(was_locked) << k;
  }
}

// HDF5 calls the function that reads, and would not survive an exception.
TEST_F(InterruptedTrajectory, ADiskThatCannotBeReadIsOneMessage) {
  long call = 0;
  for (bool fails = true; fails; ++call) {
    fault = Fault::unreadable;
    calls_before_fault = call;
    const std::string message = file_error([&] {
      TrajectoryReader(file("start.h5")).read(first);
      fails = false;
    });
    fault = Fault::none;
    EXPECT_EQ(fails, message.find("start.h5: cannot ") != std::string::npos &&
                         message.find("Input/output error") != std::string::npos)
        << "call " << call << ": " << message;
    if (HasFailure()) return;
  }
  EXPECT_GT(call, 20);
}

TEST_F(Interrupted, ANewFileIsThereWholeOrNotAtAll) {
  for (const Fault kind : {Fault::kill, Fault::full_disk}) {
    long call = 0;
    for (;; ++call) {
      fs::remove(file("state.h5"));
      if (!struck(kind, call, [&] { write_state(file("state.h5"), frame(5), Provenance()); }))
        break;
      EXPECT_FALSE(fs::exists(file("state.h5")));
    }
    EXPECT_GT(call, 3);
    EXPECT_EQ(read_state(file("state.h5")).position, frame(5).position);
  }
}

TEST_F(Interrupted, ACheckpointIsTheOldOneOrTheNewOne) {
  for (const Fault kind : {Fault::kill, Fault::full_disk}) {
    const auto at = [](std::uint64_t k) {
      return Checkpoint{frame(k), {}, {{"k", k}}, {}, {}, ""};
    };
    save_checkpoint(file("c"), at(1));
    save_checkpoint(file("c"), at(2));
    long call = 0;
    while (struck(kind, call, [&] { save_checkpoint(file("c"), at(3)); })) {
      ++call;
      EXPECT_EQ(load_checkpoint(file("c")).checkpoint.counters.at("k"), 2u);
      EXPECT_EQ(load_checkpoint(file("c.previous")).checkpoint.counters.at("k"), 1u);
    }
    EXPECT_GT(call, 3);
    EXPECT_EQ(load_checkpoint(file("c")).checkpoint.counters.at("k"), 3u);
  }
}

std::span<const std::byte> bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST_F(Interrupted, NothingShowsBeforeTheCommit) {
  using Mode = TransactionalFile::Mode;
  const auto begin = commit_record_block;
  const auto content = [](TransactionalFile& file) {
    std::string text(file.size() - begin, '?');
    EXPECT_TRUE(file.read(begin, std::as_writable_bytes(std::span(text))));
    return text;
  };
  {
    TransactionalFile file(this->file("f"), Mode::create);
    file.write(begin, bytes(std::string(10'000, 'a')));
    file.commit();
    EXPECT_EQ(file.free_from(), begin + 10'008);
    file.write(begin + 5'000, bytes(std::string(20'000, 'b')));
    EXPECT_EQ(content(file), std::string(5'000, 'a') + std::string(20'000, 'b'));
  }
  TransactionalFile file(this->file("f"), Mode::write);
  EXPECT_EQ(content(file), std::string(10'000, 'a'));
  file.write(begin + 1, bytes("bc"));
  file.commit();
  EXPECT_EQ(content(file).substr(0, 10'000), "abc" + std::string(9'997, 'a'));
  file.resize(begin + 20'000);
  file.commit();
  EXPECT_EQ(content(file).substr(10'016), std::string(9'984, '\0'));
}

}  // namespace
}  // namespace vitrel
