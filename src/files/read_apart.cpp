#include "files/read_apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

// Far more than any sound file has needed.
constexpr double kSeconds = 5, kSecondsPerByte = 2e-6;
constexpr double kPatience = 10;  // of those seconds, on a machine that does other things as well
constexpr double kBytes = 1 << 30, kBytesPerByte = 400;

struct Limits {
  rlim_t seconds, bytes;
};
Limits limits_of(const std::string& path) {
  std::error_code error;
  const double size = static_cast<double>(std::filesystem::file_size(path, error));
  return {static_cast<rlim_t>(kSeconds + kSecondsPerByte * (error ? 0 : size)), static_cast<rlim_t>(kBytes + kBytesPerByte * (error ? 0 : size))};
}

/// Address space that this process has, bytes.
rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void at_most(int resource, rlim_t amount) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min(amount, limit.rlim_max);
  setrlimit(resource, &limit);
}

void write_all(int to, const std::vector<char>& data) {
  for (std::size_t at = 0; at < data.size();) {
    const ssize_t done = write(to, data.data() + at, data.size() - at);
    if (done < 0 && errno != EINTR) return;
    if (done > 0) at += static_cast<std::size_t>(done);
  }
}

/// Until the end, or until nothing comes for so long, s: then `late` is set. The child may hold a lock for ever that another
/// thread of its parent had taken, and no limit of its time counts while it waits.
std::vector<char> read_all(int from, double seconds, bool& late) {
  std::vector<char> data, part(1 << 16);
  for (;;) {
    pollfd ready{from, POLLIN, 0};
    const int any = poll(&ready, 1, static_cast<int>(std::min(1e3 * seconds, 1e9)));
    if (any < 0 && errno == EINTR) continue;
    late = any == 0;
    if (late) return {};
    const ssize_t got = read(from, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return data;
    data.insert(data.end(), part.begin(), part.begin() + got);
  }
}

/// A code (success where there is none) and the bytes or the message: the child's answer.
std::vector<char> answer_of(const std::function<std::vector<char>()>& read) {
  Writer answer;
  const auto failed = [&](Code code, const std::string& what) {
    answer.number(code);
    answer.text(what);
    return answer.take();
  };
  try {
    const std::vector<char> bytes = read();
    answer.number(Code::success);
    answer.list(bytes);
    return answer.take();
  } catch (const Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::exception& error) {
    return failed(Code::none, error.what());
  } catch (...) {
    return failed(Code::none, "an exception without a name");
  }
}

[[noreturn]] void serve(int to, const Limits& limits, const std::function<std::vector<char>()>& read) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGINT, SIG_IGN);  // of a terminal, which reaches all: it is the parent's to answer
  for (int broken : {SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGPIPE}) signal(broken, SIG_DFL);
  at_most(RLIMIT_CORE, 0);
  at_most(RLIMIT_CPU, limits.seconds);
  at_most(RLIMIT_AS, address_space() + limits.bytes);
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {  // what the libraries print
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  write_all(to, answer_of(read));
  _exit(0);
}

}  // namespace

std::vector<char> bytes_read_apart(const std::string& source, const std::string& path, const std::function<std::vector<char>()>& read) {
  const auto refuse = [&](const std::string& what) { throw Error(Code::mesh_error, source + ": " + what); };
  const Limits limits = limits_of(path);
  static std::mutex one_at_a_time;  // a child that another thread forks meanwhile would keep this one's pipe open
  int ends[2];
  std::unique_lock<std::mutex> forking(one_at_a_time);
  if (pipe2(ends, O_CLOEXEC) != 0) refuse(std::string("no pipe to a process that reads it: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child == 0) serve(ends[1], limits, read);
  const int why = errno;
  close(ends[1]);
  forking.unlock();
  bool late = false;
  const std::vector<char> answer = child > 0 ? read_all(ends[0], kPatience * static_cast<double>(limits.seconds), late) : std::vector<char>();
  if (late) kill(child, SIGKILL);
  close(ends[0]);
  if (child < 0) refuse(std::string("no process to read it in: ") + std::strerror(why));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}

  const std::string remedy = "; the file is damaged or cut short: write it again";
  if (late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    refuse("reading it has taken more than " + std::to_string(limits.seconds) + " s and did not end" + remedy);
  if (WIFSIGNALED(status)) refuse(std::string("the library that reads it breaks (") + strsignal(WTERMSIG(status)) + ")" + remedy);
  if (answer.empty()) refuse("the library that reads it ends the process" + remedy);
  Reader in(answer);
  Code code = Code::none;
  in.number(code);
  if (code == Code::success) {
    std::vector<char> bytes;
    in.list(bytes);
    return bytes;
  }
  std::string what;
  in.text(what);
  if (code == Code::none) refuse("the library that reads it cannot (" + what + ")" + remedy);
  throw Error(code, what);
}

}  // namespace forming_sim
