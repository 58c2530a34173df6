// SPDX-License-Identifier: MIT
//
// Files that appear complete or not at all.
#include <slant/io/atomic_file.hpp>

#include <sys/resource.h>
#include <sys/stat.h>
#include <csignal>
#include <support/testing.hpp>
#include <system_error>
#include "io_support.hpp"

namespace atomic_file_test {

using io_test::get;
using io_test::put;
using io_test::temporary_folder;
using test::complaint;
namespace fs = std::filesystem;

/// While it lives no file of this process can grow beyond that many bytes, as on a full disk.
class full_disk {
 public:
  explicit full_disk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  full_disk(full_disk const&) = delete;
  full_disk& operator=(full_disk const&) = delete;
  ~full_disk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_CASE("atomic file: appears at commit, whole") {
  temporary_folder const folder;
  slant::atomic_file file(folder / "a.txt");
  file.write("one\n");
  file.write(std::string(100000, 'x'));
  CHECK_FALSE(fs::exists(folder / "a.txt"));
  file.commit();
  CHECK(get(folder / "a.txt") == "one\n" + std::string(100000, 'x'));
  CHECK(folder.entries() == 1);
  file.commit();  // nothing more to do
  CHECK(folder.entries() == 1);
  CHECK_THROWS_AS(file.write("late"), std::logic_error);
}

TEST_CASE("atomic file: a full disk leaves everything as it was") {
  temporary_folder const folder;
  put(folder / "old.txt", "old");
  for (std::string const name : {"new.txt", "old.txt"}) {
    bool thrown = false;
    std::string message;
    {
      full_disk const disk(1000);
      try {
        slant::atomic_file file(folder / name);
        file.write(std::string(100000, 'x'));
        file.commit();
      } catch (std::system_error const& error) {
        thrown = error.code() == std::errc::file_too_large;
        message = error.what();
      }
    }
    CHECK(thrown);
    CHECK(message == "writing " + (folder / name).string() + ": File too large");
  }
  CHECK(get(folder / "old.txt") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("atomic file: targets that cannot be files") {
  temporary_folder const folder;
  std::string const root = folder.path().string();
  auto const message = [&](fs::path const& target) {
    return complaint([&] { slant::atomic_file const file(target); });
  };
  CHECK(message(folder.path()) ==
        root + ": got a directory, expected a file name in a writable folder");
  CHECK(
      message(folder / "none/a.txt") ==
      root +
          "/none/a.txt: got No such file or directory, expected a file name in a writable folder");
  CHECK(message(folder / "none/") ==
        root + "/none/: got a path without a file name, expected a file name in a writable folder");
  fs::path const pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(message(pipe) ==
        root + "/pipe: got a special file, expected a file name in a writable folder");
  put(folder / "file", "");
  CHECK(message(folder / "file/a.txt") ==
        root + "/file/a.txt: got Not a directory, expected a file name in a writable folder");
  fs::create_symlink(folder / "nowhere", folder / "link");
  CHECK(message(folder / "link") ==
        root + "/link: got a symbolic link to nowhere, expected a file name in a writable folder");
  CHECK(message("") ==
        ": got a path without a file name, expected a file name in a writable folder");
  CHECK(folder.entries() == 3);
}

TEST_CASE("atomic file: a link stays a link, permissions are the usual ones, long names work") {
  temporary_folder const folder;
  put(folder / "real.txt", "old");
  fs::create_symlink(folder / "real.txt", folder / "link.txt");
  slant::atomic_file file(folder / "link.txt");
  file.write("new");
  file.commit();
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(get(folder / "real.txt") == "new");

  put(folder / "usual.txt", "");
  CHECK(fs::status(folder / "real.txt").permissions() ==
        fs::status(folder / "usual.txt").permissions());

  std::string const longest(255, 'n');
  slant::atomic_file named(folder / longest);
  named.commit();
  CHECK(fs::exists(folder / longest));
}

TEST_CASE("atomic file: in the current folder, and moved") {
  temporary_folder const folder;
  fs::path const before = fs::current_path();
  fs::current_path(folder.path());
  {
    slant::atomic_file first("here.txt");
    first.write("a");
    slant::atomic_file second(std::move(first));
    second.write("b");
    second.commit();
  }
  fs::current_path(before);
  CHECK(get(folder / "here.txt") == "ab");
  CHECK(folder.entries() == 1);
}

TEST_CASE("atomic files: all or none") {
  temporary_folder const folder;
  put(folder / "u.txt", "old u");
  {
    slant::atomic_files files;
    files.add(folder / "u.txt").write("new u");
    files.add(folder / "lambda.txt").write("new lambda");
    CHECK(SLANT_COMPLAINT(files.add(folder / "missing/x.txt")) != "nothing thrown");
  }
  CHECK(get(folder / "u.txt") == "old u");
  CHECK(folder.entries() == 1);

  slant::atomic_files files;
  slant::atomic_file& u = files.add(folder / "u.txt");
  slant::atomic_file& lambda = files.add(folder / "lambda.txt");
  u.write("new u");
  lambda.write("new lambda");
  CHECK(folder.entries() == 3);
  files.seal();
  CHECK(get(folder / "u.txt") == "old u");
  CHECK(folder.entries() == 3);
  files.commit();
  CHECK(get(folder / "u.txt") == "new u");
  CHECK(get(folder / "lambda.txt") == "new lambda");
  CHECK(folder.entries() == 2);
}

TEST_CASE("atomic files: one that cannot be written stops all") {
  temporary_folder const folder;
  put(folder / "u.txt", "old u");
  slant::atomic_files files;
  files.add(folder / "u.txt").write("new u");
  // Too long for the disk, short enough to wait in the buffer until the end.
  files.add(folder / "lambda.txt").write(std::string(3000, 'x'));
  {
    full_disk const disk(1000);
    CHECK_THROWS_AS(files.commit(), std::system_error);
  }
  CHECK(get(folder / "u.txt") == "old u");
  CHECK(folder.entries() == 1);
}

TEST_CASE("atomic files: one name twice") {
  temporary_folder const folder;
  slant::atomic_files files;
  files.add(folder / "u.txt");
  CHECK(SLANT_COMPLAINT(files.add(folder / "./u.txt")) ==
        (folder / "./u.txt").string() +
            ": got a file that is already being written, expected different names");
}

}  // namespace atomic_file_test
