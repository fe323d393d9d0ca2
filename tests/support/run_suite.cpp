// run_suite [--seconds N] SUITE [OPTION...]: runs a suite and prints its report.
//
// The suite contains code that is being written. It may crash, hang, or leave
// by std::exit(0) before the last test. None of this happens to the program
// here, which has none of that code: it passes a suite that came to its end,
// and of any other it says in which test that happened.

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "support/report.hpp"

namespace {

using namespace lightwalk::tests;
using Clock = std::chrono::steady_clock;

/// How long the tests of a process have been going on. A thread that would
/// run, and waits for its turn because the machine is busy with others, does
/// not count for that while: no right test is stopped for its neighbours.
/// Waiting for anything else does count.
class Stopwatch {
 public:
  explicit Stopwatch(pid_t process) : process_(process) {}

  void restart() { seconds_ = 0; }

  double seconds() {
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    double running = 0, waiting = 0;
    std::map<std::string, Times> threads = times();
    for (const auto& [thread, time] : threads) {
      running += time.running - threads_[thread].running;
      waiting += time.waiting - threads_[thread].waiting;
    }
    threads_ = std::move(threads);
    const double wanted = running + waiting;
    seconds_ += wanted > 0 ? passed * running / wanted : passed;
    return seconds_;
  }

 private:
  struct Times {
    double running = 0, waiting = 0;  ///< nanoseconds
  };

  /// Of each thread, as Linux counts them; elsewhere none.
  std::map<std::string, Times> times() const {
    std::map<std::string, Times> result;
    const std::string folder = "/proc/" + std::to_string(process_) + "/task/";
    if (DIR* const tasks = opendir(folder.c_str())) {
      while (const dirent* const task = readdir(tasks)) {
        std::ifstream file(folder + task->d_name + "/schedstat");
        Times one;
        if (file >> one.running >> one.waiting) result[task->d_name] = one;
      }
      closedir(tasks);
    }
    return result;
  }

  pid_t process_;
  Clock::time_point last_ = Clock::now();
  double seconds_ = 0;
  std::map<std::string, Times> threads_;
};

std::string crash_in_words(int signal) {
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
      return "it used memory that it does not have (an index out of range, a "
             "null pointer), or its functions called each other without an "
             "end";
    case SIGFPE:
      return "an integer was divided by zero";
    case SIGABRT:
      return "std::abort: a failed assert, or an exception that nobody "
             "caught; "
             "the lines above may say which";
    default:
      return std::string("signal ") + strsignal(signal);
  }
}

/// What the suite has told so far.
struct Listener {
  Report report;
  std::string unread;
  bool done = false;
  unsigned tests = 0;

  void hear(const std::string& text, Stopwatch& watch) {
    unread += text;
    for (std::size_t end; (end = unread.find('\n')) != std::string::npos;) {
      const std::vector<std::string> fields =
          fields_of(unread.substr(0, end));
      unread.erase(0, end + 1);
      const std::string& what = fields[0];
      if (what == "begin" && fields.size() == 3) {
        report.begin_test(fields[1], std::atoi(fields[2].c_str()));
        watch.restart();
      } else if (what == "fail" && fields.size() == 3) {
        report.fail(fields[1], fields[2]);
      } else if (what == "note" && fields.size() == 2) {
        report.note(fields[1]);
      } else if (what == "end") {
        report.end_test();
      } else if (what == "alive") {
        watch.restart();
      } else if (what == "done" && fields.size() == 2) {
        done = true;
        tests += static_cast<unsigned>(std::atoi(fields[1].c_str()));
      }
    }
  }
};

/// How a run of the suite ended.
struct End {
  bool late = false;
  int status = 0;  ///< as waitpid tells it
};

/// Starts the suite, which tells what it does on `pipe_end`.
pid_t start(const std::vector<std::string>& command, int pipe_end) {
  setenv(pipe_variable, std::to_string(pipe_end).c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));
  }
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child > 0) return child;
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind
#endif
  execv(words[0], words.data());
  std::fprintf(stderr, "run_suite: %s: %s\n", words[0], std::strerror(errno));
  std::_Exit(127);
}

/// Runs the suite to its end, or until a test has been going on for too long.
End listen(const std::vector<std::string>& command, double most_seconds,
           Listener& suite) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  const pid_t child = start(command, ends[1]);
  close(ends[1]);
  suite.done = false;

  End end;
  Stopwatch watch(child);
  for (bool over = false; !over;) {
    // It is over when the suite has ended, though a process that it has
    // started may hold the pipe; what was written is read all the same.
    over = waitpid(child, &end.status, WNOHANG) == child;
    pollfd one{ends[0], POLLIN, 0};
    poll(&one, 1, over ? 0 : 50);
    char text[4096];
    ssize_t size = 0;
    while ((size = read(ends[0], text, sizeof text)) > 0) {
      suite.hear(std::string(text, static_cast<std::size_t>(size)), watch);
    }
    if (over) break;
    if (size == 0) {  // closed, and about to end
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (watch.seconds() > most_seconds) {
      end.late = over = true;
      kill(child, SIGKILL);
      waitpid(child, &end.status, 0);
    }
  }
  close(ends[0]);
  return end;
}

/// Why a run is none that passes, as a sentence about the test `when` it
/// ended. Empty where the suite came to its end.
std::string broken_off(const End& end, const Listener& suite,
                       double most_seconds) {
  const std::string when =
      suite.report.running()
          ? " during the test\n\"" + suite.report.current_test() + "\"\n"
      : suite.done ? " after the last test\n"
                   : " between two tests, or before the first\n";
  if (end.late) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", most_seconds);
    return "The tests do not end: stopped" + when +
           "which had been going on for " + seconds +
           " seconds. A loop or a path without an end? A lock that is never "
           "released?";
  }
  if (WIFSIGNALED(end.status)) {
    return "The tests crashed" + when + crash_in_words(WTERMSIG(end.status));
  }
  const std::string code = std::to_string(WEXITSTATUS(end.status));
  if (!suite.done) {
    return "The program left by std::exit or the like, exit code " + code +
           "," + when +
           "so the tests did not come to their end, and have "
           "not passed.";
  }
  if (code != "0" && !suite.report.failed()) {
    return "The program ended with exit code " + code + when +
           "though no test failed. The lines above may say why.";
  }
  return "";
}

/// Options of doctest's that run one kind of tests each, the sharpest first,
/// and those that are in no suite with the scenes.
std::vector<std::string> filters() {
  std::vector<std::string> result;
  std::string others;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    result.push_back("-ts=" + std::string(kinds[i]));
    if (i == 1) continue;
    others += (others.empty() ? "" : ",") + std::string(kinds[i]);
  }
  result[1] = "-tse=" + others;
  return result;
}

int run(const std::vector<std::string>& command, double most_seconds) {
  const std::string program =
      std::filesystem::absolute(command[0]).lexically_normal().string();
  Listener suite;
  std::string text;
  for (const std::string& filter : filters()) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"-r=brief", filter});
    const End end = listen(words, most_seconds, suite);
    if (WIFSIGNALED(end.status) && WTERMSIG(end.status) == SIGINT) return 1;
    const std::string why = broken_off(end, suite, most_seconds);
    if (why.empty()) continue;
    text = suite.report.broken_off(why, program);
    break;
  }
  const bool passed =
      text.empty() && suite.tests > 0 && !suite.report.failed();
  if (text.empty()) {
    text = suite.tests > 0 ? suite.report.summary(suite.tests, program)
                           : "no test has such a name\n";
  }
  std::fputs(text.c_str(), stdout);
  return passed ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  double seconds = MOST_SECONDS;
  if (words.size() > 2 && words[0] == "--seconds") {
    seconds = std::atof(words[1].c_str());
    words.erase(words.begin(), words.begin() + 2);
  }
  if (words.empty()) {
    std::fputs("run_suite [--seconds N] SUITE [OPTION...]\n", stderr);
    return 2;
  }
  try {
    return run(words, seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "run_suite: %s\n", error.what());
    return 2;
  }
}
