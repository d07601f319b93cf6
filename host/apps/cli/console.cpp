#include "host/apps/cli/console.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

#include "host/apps/cli/exit_status.hpp"

namespace verp::cli {

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Opens the lowest free descriptor.
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  }
}

void answer(const std::string& text) {
  std::fputs(text.c_str(), stdout);
}

void complain(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

int after_the_answer(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  struct stat out {};
  if (::fstat(STDOUT_FILENO, &out) == 0 && S_ISFIFO(out.st_mode)) return status;  // `| head`
  complain(
      "verp: the answer could not be written to standard output; free space, or send it elsewhere");
  return status != kGood ? status : kRunFailed;
}

}  // namespace verp::cli
