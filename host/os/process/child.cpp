#include "host/os/process/child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <utility>

namespace verp::process {
namespace {

constexpr int kFirstFree = STDERR_FILENO + 1;  // lower numbers are standard streams

/// A failed start writes its error; exec closes the pipe.
struct Report {
  int read_end = -1, write_end = -1;

  Report() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "no pipe");
    }
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Report() {
    ::close(read_end);
    if (write_end >= 0) ::close(write_end);
  }
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;

  /// The error number, or 0; waits for either.
  int read() {
    ::close(std::exchange(write_end, -1));
    int error = 0;
    ssize_t count = 0;
    do {
      count = ::read(read_end, &error, sizeof error);
    } while (count < 0 && errno == EINTR);
    return count == sizeof error ? error : 0;
  }
};

/// The program's path in PATH; `program` itself if it contains a slash or is not found. execvp()
/// would pass a file that is no program to a shell, whose message is misleading.
std::string place_of(const std::string& program) {
  const char* path = std::getenv("PATH");
  if (path == nullptr || program.find('/') != std::string::npos) return program;
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = (folder.empty() ? "." : folder) + "/" + program;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return program;
}

/// The forked child before exec. Only async-signal-safe calls and no memory: another thread's lock
/// may be held forever.
class Becoming {
 public:
  Becoming(const Command& command, const char* program, char* const* words, int report)
      : command_(command), program_(program), words_(words), report_(report) {}

  [[noreturn]] void become(pid_t parent) {
    // If our standard streams are closed, the report may have one of their numbers.
    report_ = must(::fcntl(report_, F_DUPFD_CLOEXEC, kFirstFree));
    must(::setpgid(0, 0));
    if (command_.ends_with_thread) must(::prctl(PR_SET_PDEATHSIG, SIGKILL));
    if (::getppid() != parent) ::_exit(kNotStarted);  // the parent died first
    const int input = open(command_.input, O_RDONLY);
    const int output = open(command_.output, O_WRONLY | O_CREAT | O_TRUNC);
    const int error = command_.error ? open(*command_.error, O_WRONLY | O_CREAT | O_TRUNC) : output;
    must(::dup2(input, STDIN_FILENO));
    must(::dup2(output, STDOUT_FILENO));
    must(::dup2(error, STDERR_FILENO));
    if (!command_.folder.empty()) must(::chdir(command_.folder.c_str()));
    must(::execv(program_, words_));
    ::_exit(kNotStarted);
  }

 private:
  static constexpr int kNotStarted = 127;

  int must(int result) const {
    if (result >= 0) return result;
    const int error = errno;
    const ssize_t told = ::write(report_, &error, sizeof error);
    ::_exit(told == sizeof error ? kNotStarted : kNotStarted - 1);
  }
  int open(const Stream& stream, int flags) const {
    if (stream.descriptor >= 0) {
      return must(::fcntl(stream.descriptor, F_DUPFD_CLOEXEC, kFirstFree));
    }
    const char* name = stream.file.empty() ? "/dev/null" : stream.file.c_str();
    const int opened = must(::open(name, flags | O_CLOEXEC, 0600));
    return opened >= kFirstFree ? opened : must(::fcntl(opened, F_DUPFD_CLOEXEC, kFirstFree));
  }

  const Command& command_;
  const char* program_;
  char* const* words_;
  int report_;
};

}  // namespace

Child::Child(const Command& command) {
  std::vector<std::string> own = command.words;
  std::vector<char*> words;
  words.reserve(own.size() + 1);
  for (std::string& word : own) words.push_back(word.data());
  words.push_back(nullptr);
  const std::string program = place_of(own[0]);
  Report report;
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) Becoming(command, program.c_str(), words.data(), report.write_end).become(parent);
  const int error = pid_ < 0 ? errno : report.read();
  if (error == 0) return;
  if (pid_ > 0) reap(0);
  throw std::system_error(error, std::generic_category(), own[0]);
}

Child::~Child() {
  if (status()) return;
  tell(SIGKILL);
  reap(0);
}

void Child::tell(int signal) const {
  if (!status_) ::kill(-pid_, signal);
}

std::optional<int> Child::status() {
  return reap(WNOHANG);
}

int Child::wait() {
  return *reap(0);
}

std::optional<int> Child::reap(int flags) {
  int status = 0;
  while (!status_) {
    const pid_t ended = ::waitpid(pid_, &status, flags);
    if (ended == 0) break;
    if (ended < 0 && errno == EINTR) continue;
    // Another waiter took the status; the process has ended.
    status_ = ended < 0           ? 128 + SIGKILL
              : WIFEXITED(status) ? WEXITSTATUS(status)
                                  : 128 + WTERMSIG(status);
  }
  return status_;
}

std::string last_line(const std::string& output) {
  std::size_t end = output.size();
  while (end > 0 && (std::isspace(static_cast<unsigned char>(output[end - 1])) != 0)) --end;
  if (end == 0) return "nothing";
  const std::size_t before = output.find_last_of("\r\n", end - 1);
  const std::size_t begin = before == output.npos ? 0 : before + 1;
  return output.substr(begin, end - begin);
}

}  // namespace verp::process
