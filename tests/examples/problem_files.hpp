// SPDX-License-Identifier: MIT
//
// Problems as folders of files: a small brick, or a few numbers by hand.
#pragma once

#include <fem/steel_brick.hpp>
#include <fem/write_folder.hpp>
#include <nlohmann/json.hpp>
#include <slant/io/matrix_market.hpp>
#include <string>
#include <string_view>

#include "run_program.hpp"

namespace examples_test {

namespace fs = std::filesystem;

/// Begins a sparse matrix.
inline std::string const coordinate = "%%MatrixMarket matrix coordinate real general\n";

/// A folder with a problem, and one beside it for results; both vanish with the object.
class problem_files {
 public:
  problem_files() = default;
  template <int D>
  explicit problem_files(fem::contact_scene<D> const& scene) {
    fem::write_folder(scene, input());
  }

  [[nodiscard]] fs::path input() const { return root_ / "input"; }
  [[nodiscard]] fs::path output() const { return root_ / "output"; }

  void put(std::string_view name, std::string_view text) const {
    fs::create_directories(input());
    io_test::put(input() / name, text);
  }
  void remove(std::string_view name) const { fs::remove(input() / name); }

  /// Number of files in the folder for results, hidden ones included; 0 if there is no folder.
  [[nodiscard]] int files_written() const {
    if (!fs::exists(output())) return 0;
    int count = 0;
    for (auto const& entry : fs::recursive_directory_iterator(output())) {
      (void)entry;
      ++count;
    }
    return count;
  }
  [[nodiscard]] Eigen::VectorXd read(std::string_view name) const {
    return slant::read_text_vector(output() / name);
  }

  /// from_files DIR options --output …
  [[nodiscard]] program_result solve(std::string const& options = "") const {
    return run("from_files",
               word(input().string()) + " " + options + " --output " + word(output().string()));
  }

 private:
  io_test::temporary_folder root_{};
};

/// The brick of 3 × 1 × 1 cells under the load that opens a part of its contact.
[[nodiscard]] inline problem_files small_brick() {
  return problem_files(fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift}));
}

/// A block of rubber in the plane, pressed down and pulled to the right.
[[nodiscard]] inline fem::contact_scene<2> plane_scene() {
  return fem::make_contact_scene<2>(
      {.mesh = fem::make_box_mesh<2>({4, 2}, Eigen::Vector2d(2, 1)),
       .material = fem::lame(10, 0.3),
       .fixed = {.axis = 0, .upper = false},
       .contact = {.axis = 1, .upper = false},
       .loads = {{{.axis = 1, .upper = true}, Eigen::Vector2d(0, -1)},
                 {{.axis = 0, .upper = true}, Eigen::Vector2d(0.6, 0.5)}},
       .slip_bound = 0.3});
}

/// What from_files says of a problem that it solves with these options: one line, and no complaint.
[[nodiscard]] inline nlohmann::json solved(problem_files const& files,
                                           std::string const& options = "") {
  auto const ran = files.solve(options);
  CHECK(ran.status == 0);
  CHECK(ran.err == "");
  REQUIRE(is_one_line(ran.out));
  return nlohmann::json::parse(ran.out);
}

/// A refusal of from_files.
inline void check_refusal(program_result const& ran, std::string const& expected) {
  check_refused(ran, expected);
  CHECK(ran.err.starts_with("from_files: "));
}
/// These files with these options are refused, and nothing is written.
inline void check_refusal(problem_files const& files, std::string const& options,
                          std::string const& expected) {
  check_refusal(files.solve(options), expected);
  CHECK(files.files_written() == 0);
}

}  // namespace examples_test
