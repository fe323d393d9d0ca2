#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace lightwalk {

/// Calls a function again and again, in a thread of its own, until it is
/// destroyed. Where the system gives no thread it is never called.
class Periodically {
 public:
  Periodically(std::chrono::milliseconds pause, std::function<void()> act) {
    try {
      thread_ = std::thread([this, pause, act = std::move(act)] {
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, pause, [this] { return done_; })) act();
      });
    } catch (const std::exception&) {
      // What is only watched goes on without being watched.
    }
  }
  Periodically(const Periodically&) = delete;
  Periodically& operator=(const Periodically&) = delete;
  ~Periodically() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace lightwalk
