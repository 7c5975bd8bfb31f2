// SPDX-License-Identifier: BSD-3-Clause
// Counts the pages of memory that a piece of work touches: they are protected, and each one is opened by the
// first touch. Linux; one watch at a time.
#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

namespace sslam::testing {

class PageWatch {
 public:
  PageWatch() {
    current_ = this;
    struct sigaction action {};
    action.sa_sigaction = &PageWatch::touched_at;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGSEGV, &action, &before_);
  }
  ~PageWatch() {
    open_all();
    sigaction(SIGSEGV, &before_, nullptr);
    current_ = nullptr;
  }
  PageWatch(const PageWatch&) = delete;
  PageWatch& operator=(const PageWatch&) = delete;

  // The whole pages between two places are watched from here on.
  void add(const void* first, const void* last) {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = (reinterpret_cast<std::uintptr_t>(first) + page - 1) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(last) / page * page;
    for (std::uintptr_t at = begin; at < end; at += page) {
      pages_.push_back({at, page, places_, false});
      mprotect(reinterpret_cast<void*>(at), page, PROT_NONE);
    }
    ++places_;
  }

  // Of the pages between each two places, how many there are and how many have been touched.
  struct Count {
    std::size_t pages = 0, touched = 0;
  };
  std::vector<Count> open_all() {
    std::vector<Count> counts(places_);
    for (const Page& page : pages_) {
      ++counts[page.place].pages;
      counts[page.place].touched += page.open;
      open(page);
    }
    pages_.clear();
    places_ = 0;
    return counts;
  }

 private:
  struct Page {
    std::uintptr_t begin, size;
    std::size_t place;
    bool open;
  };

  static void open(const Page& page) {
    mprotect(reinterpret_cast<void*>(page.begin), page.size, PROT_READ | PROT_WRITE);
  }

  static void touched_at(int, siginfo_t* info, void*) {
    const auto at = reinterpret_cast<std::uintptr_t>(info->si_addr);
    for (Page& page : current_->pages_)
      if (at >= page.begin && at < page.begin + page.size && !page.open) {
        page.open = true;
        open(page);
        return;
      }
    sigaction(SIGSEGV, &current_->before_, nullptr);  // not ours: it happens again, to whom it concerns
  }

  inline static PageWatch* current_ = nullptr;
  std::vector<Page> pages_;
  std::size_t places_ = 0;
  struct sigaction before_ {};
};

}  // namespace sslam::testing
