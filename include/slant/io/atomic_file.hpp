// SPDX-License-Identifier: MIT
//
// Files that appear complete or not at all.
//
// Text goes to a temporary file in the same folder (the same file system, where rename is atomic);
// commit() forces it to the disk and renames it over the target. Until then the target, or its
// absence, is untouched, and a writer that gives up leaves nothing behind. A process that is killed
// may leave a temporary file, never a damaged target.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <slant/concepts/bad_input.hpp>
#include <slant/io/text_scanner.hpp>
#include <string_view>
#include <system_error>
#include <utility>

namespace slant {

/// One file to be written. Owns its temporary file: destroyed without commit(), it removes it.
class atomic_file {
 public:
  /// Creates the temporary file. A symbolic link is followed: the file it names will be replaced.
  /// Throws bad_input if the target cannot be a file here: its folder is missing or not writable,
  /// or it is a directory or a device.
  explicit atomic_file(std::filesystem::path target) : target_(std::move(target)) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(target_, error))) {
      fs::path const end = fs::canonical(target_, error);
      if (error) refuse("a symbolic link to nowhere");
      target_ = end;
    }
    fs::file_status const status = fs::status(target_, error);
    if (status.type() == fs::file_type::directory) refuse("a directory");
    if (fs::exists(status) && status.type() != fs::file_type::regular) refuse("a special file");
    if (!target_.has_filename()) refuse("a path without a file name");
    create_temporary();
  }

  atomic_file(atomic_file&& other) noexcept
      : target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        stream_(std::exchange(other.stream_, nullptr)) {}
  atomic_file& operator=(atomic_file&&) = delete;
  ~atomic_file() { discard(); }

  [[nodiscard]] std::filesystem::path const& target() const { return target_; }

  /// Appends text. Throws std::system_error if there is no room.
  void write(std::string_view text) {
    if (stream_ == nullptr) throw std::logic_error("atomic_file: written to after commit");
    if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail(errno);
  }

  /// Forces the content to the disk and closes the temporary file; it only remains to be renamed.
  /// Throws std::system_error.
  void seal() {
    if (stream_ == nullptr) return;
    bool const flushed = std::fflush(stream_) == 0 && ::fsync(::fileno(stream_)) == 0;
    int const reason = errno;
    bool const closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
    if (!flushed) fail(reason);
    if (!closed) fail(errno);
  }

  /// Makes the content appear under the target's name. Throws std::system_error.
  void commit() {
    seal();
    if (temporary_.empty()) return;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail(error.value());
    temporary_.clear();
  }

  /// Removes the temporary file; the target stays as it was.
  void discard() noexcept {
    if (stream_ != nullptr) std::fclose(std::exchange(stream_, nullptr));
    if (temporary_.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
    temporary_.clear();
  }

 private:
  void create_temporary() {
    static std::atomic<unsigned> counter{0};
    std::filesystem::path const folder = target_.parent_path();
    for (;;) {
      // Short and independent of the target's name, which may already be as long as names can be.
      std::filesystem::path const name =
          folder / (".slant-" + detail::show(::getpid()) + "-" + detail::show(counter++) + ".part");
      int const descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno == EEXIST) continue;  // left by a killed process of this number
      if (descriptor < 0) refuse(std::generic_category().message(errno));
      temporary_ = name;
      stream_ = ::fdopen(descriptor, "wb");
      if (stream_ != nullptr) return;
      int const reason = errno;
      ::close(descriptor);
      fail(reason);
    }
  }

  [[noreturn]] void refuse(std::string_view value) const {
    throw bad_input(detail::printable(target_), value, "a file name in a writable folder");
  }

  /// The destructor does not run when the constructor throws, and a writer may keep the object
  /// after a failure: so the temporary file goes here.
  [[noreturn]] void fail(int reason) {
    discard();
    throw std::system_error(reason, std::generic_category(),
                            "writing " + detail::printable(target_));
  }

  std::filesystem::path target_;
  std::filesystem::path temporary_{};
  std::FILE* stream_ = nullptr;
};

/// Several files that belong together. No target is touched before all contents are on the disk;
/// then they are renamed one right after the other. POSIX has no way to rename several at once: a
/// reader may see the first files new and the others old for the moment in between.
class atomic_files {
 public:
  /// Adds a file; the reference stays valid. Throws what the constructor of atomic_file throws, and
  /// bad_input for a second file of the same name.
  atomic_file& add(std::filesystem::path target) {
    atomic_file file(std::move(target));
    for (atomic_file const& other : files_)
      if (other.target().lexically_normal() == file.target().lexically_normal())
        throw bad_input(detail::printable(file.target()), "a file that is already being written",
                        "different names");
    return files_.emplace_back(std::move(file));
  }

  /// Forces all contents to the disk; it only remains to rename. If one cannot be written all
  /// temporary files are removed. Throws std::system_error.
  void seal() {
    all([](atomic_file& file) { file.seal(); });
  }

  /// Seals all, then renames all. If one cannot be sealed no target changes; where one cannot be
  /// renamed those before it have changed. All temporary files are removed. Throws
  /// std::system_error.
  void commit() {
    seal();
    all([](atomic_file& file) { file.commit(); });
  }

 private:
  template <class Action>
  void all(Action act) {
    try {
      for (atomic_file& file : files_) act(file);
    } catch (...) {
      for (atomic_file& file : files_) file.discard();
      throw;
    }
  }

  std::deque<atomic_file> files_{};
};

}  // namespace slant
