#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>

#include "program.hpp"

namespace lanescape::program {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

extern "C" void on_stop_signal(int signal) {
  stop_signal = 1;
  std::signal(signal, SIG_DFL);
}

using Clock = std::chrono::steady_clock;

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60) : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

void install_signal_handlers() {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
}

struct TerminalMonitor::Bar {
  std::mutex mutex;
  std::string stage;
  double done_at_start = 0.0;
  Clock::time_point start = Clock::now(), last_drawn{};

  void draw(std::string_view name, double done, double total) {
    const std::scoped_lock lock(mutex);
    const auto now = Clock::now();
    if (name != stage) {
      stage = name;
      start = now;
      done_at_start = done;
    } else if (now - last_drawn < std::chrono::milliseconds(100)) {
      return;
    }
    last_drawn = now;
    const double elapsed = std::chrono::duration<double>(now - start).count();
    const double rate = elapsed > 0.0 ? (done - done_at_start) / elapsed : 0.0;
    std::string line;
    if (total > 0.0) {
      constexpr int width = 30;
      const int filled = static_cast<int>(width * std::clamp(done / total, 0.0, 1.0));
      const std::string remaining = rate > 0.0 ? clock_text((total - done) / rate) : "-:--";
      line = fmt::format("{:<24} [{:#<{}}{:.<{}}] {:5.1f} %  {:.4g}/s  {} left", name, "", filled, "", width - filled,
                         100.0 * done / total, rate, remaining);
    } else {
      line = fmt::format("{:<24} {:.6g}  {:.4g}/s", name, done, rate);
    }
    std::cerr << "\r\033[K" << line << std::flush;
  }
};

TerminalMonitor::TerminalMonitor(bool quiet) : quiet_(quiet) {
  if (!quiet && isatty(STDERR_FILENO)) bar_ = std::make_unique<Bar>();
}

TerminalMonitor::~TerminalMonitor() {
  if (bar_) std::cerr << "\r\033[K" << std::flush;
}

void TerminalMonitor::progress(std::string_view stage, double done, double total) {
  if (bar_) bar_->draw(stage, done, total);
}

void TerminalMonitor::notice(std::string_view line) {
  if (!quiet_) std::cerr << (bar_ ? "\r\033[K" : "") << line << std::endl;
}

bool TerminalMonitor::stop_requested() const { return stop_signal != 0; }

}  // namespace lanescape::program
