// SPDX-License-Identifier: MIT
//
// The folder that results go to. Whether they will find a place is known before the computation;
// what was created for results that do not come vanishes again.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <slant/io/atomic_file.hpp>
#include <slant/io/text_vector.hpp>
#include <string>
#include <support/command_line.hpp>
#include <system_error>
#include <utility>
#include <vector>

namespace from_files {

namespace detail {

/// A folder that is created with those above it. Destroyed without keep(), what it created goes.
class new_folder {
 public:
  explicit new_folder(std::filesystem::path const& folder) : new_folder(missing(folder)) {
    examples::make_folder("--output", folder);
  }
  new_folder(new_folder const&) = delete;
  new_folder& operator=(new_folder const&) = delete;
  ~new_folder() {
    for (auto const& folder : created_) ::rmdir(folder.c_str());  // nothing but empty folders
  }
  void keep() { created_.clear(); }

 private:
  using folders = std::vector<std::filesystem::path>;

  // What was constructed here is destroyed also where the constructor that delegates throws.
  explicit new_folder(folders created) : created_(std::move(created)) {}

  /// Those on this path that do not exist yet, inner ones first.
  static folders missing(std::filesystem::path folder) {
    folders found;
    std::error_code error;
    while (!folder.empty() && !std::filesystem::exists(folder, error)) {
      found.push_back(folder);
      folder = folder.parent_path();
    }
    return found;
  }

  folders created_;
};

}  // namespace detail

/// Vectors as text in a folder. Destroyed without commit(), everything is as it was.
class result_files {
 public:
  /// Throws slant::bad_input naming the option, or a file that cannot be written there.
  result_files(std::filesystem::path folder, std::vector<std::string> names)
      : created_(folder), folder_(std::move(folder)), names_(std::move(names)) {
    slant::atomic_files probe;
    for (auto const& name : names_) probe.add(folder_ / name);
  }

  /// Puts one vector for each name on the disk, not yet under these names.
  template <class... Vectors>
  void write(Vectors const&... x) {
    auto name = names_.begin();
    (slant::write_text_vector(files_.add(folder_ / *name++), x), ...);
    files_.seal();
  }
  /// All files appear.
  void commit() {
    files_.commit();
    created_.keep();
  }

 private:
  detail::new_folder created_;  // first: it can go when the temporary files are gone
  std::filesystem::path folder_;
  std::vector<std::string> names_;
  slant::atomic_files files_{};
};

}  // namespace from_files
