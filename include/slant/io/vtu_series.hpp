// SPDX-License-Identifier: MIT
//
// A series of VTU files as one data set of ParaView: a .pvd file that lists them with their times.
//
//   vtu_series series("out/path.pvd");
//   grid.write(series.next(0.5));          // out/path_000.vtu at the time 0.5
//   grid.write(series.next(1.0));          // out/path_001.vtu
//   series.write();
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/io/atomic_file.hpp>
#include <slant/io/text_scanner.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace slant {

/// Names the files of a series and writes the list of them.
class vtu_series {
 public:
  /// Throws bad_input unless the path ends with .pvd.
  explicit vtu_series(std::filesystem::path list) : list_(std::move(list)) {
    if (list_.extension() != ".pvd" || list_.stem().empty()) {
      throw bad_input("list", list_.string(), "the name of a .pvd file");
    }
  }

  /// Where the file of the next time belongs: beside the list, numbered from 0. Throws bad_input
  /// unless times are finite and increase.
  [[nodiscard]] std::filesystem::path next(double time) {
    if (!detail::is_finite(time) || (!times_.empty() && !(time > times_.back()))) {
      throw bad_input("time", detail::show(time),
                      times_.empty() ? "a finite number"
                                     : "a number greater than " + detail::show(times_.back()));
    }
    times_.push_back(time);
    return list_.parent_path() / name_of(times_.size() - 1);
  }

  [[nodiscard]] std::size_t size() const { return times_.size(); }

  /// Writes the list; it may be written again when the series has grown. Throws as atomic_file.
  void write() const {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n <Collection>\n";
    for (std::size_t i = 0; i < times_.size(); ++i) {
      text += "  <DataSet timestep=\"" + detail::show(times_[i]) + "\" part=\"0\" file=\"" +
              escaped(name_of(i)) + "\"/>\n";
    }
    text += " </Collection>\n</VTKFile>\n";
    atomic_file file(list_);
    file.write(text);
    file.commit();
  }

 private:
  [[nodiscard, gnu::cold]] std::string name_of(std::size_t i) const {
    std::string number = std::to_string(i);
    if (number.size() < 3) number.insert(0, 3 - number.size(), '0');
    return list_.stem().string() + "_" + number + ".vtu";
  }
  [[nodiscard]] static std::string escaped(std::string const& text) {
    std::string result;
    for (char const c : text) {
      if (c == '&') {
        result += "&amp;";
      } else if (c == '<') {
        result += "&lt;";
      } else if (c == '"') {
        result += "&quot;";
      } else {
        result += c;
      }
    }
    return result;
  }

  std::filesystem::path list_;
  std::vector<double> times_{};
};

}  // namespace slant
