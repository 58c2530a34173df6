// SPDX-License-Identifier: MIT
//
// Work and precision as comma-separated values: a row for each method and tolerance, measured from
// nothing (factorisation, set-up, iterations, recovery of the solution) in a process of its own.
//
//     scene, size, unknowns, library, method, formulation    what was run
//     tolerance                                              asked for, in the method's own terms
//     seconds                                                processor seconds, median of the runs
//     error                                                  in the energy norm, relative
//     products                                               by A; of other libraries iterations
//     memory_mib                                             peak of the process
//     linear_solve_seconds                                   the same matrix, the same run
//     status
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <slant/base/report.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/iteration/stopping.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "child_process.hpp"
#include "cpu_clock.hpp"
#include "peak_memory.hpp"

namespace benchmarks {

/// The first columns, and that of the linear solve.
struct row_labels {
  std::string scene;
  std::string size;
  Eigen::Index unknowns = 0;
  double linear_solve_seconds = 0;
};

/// One run of a method.
struct outcome {
  Eigen::VectorXd x;  ///< what the error is measured of
  Eigen::Index products = 0;
  std::string_view status{};
};

/// What a method is asked for. It ends when the clock passes the deadline, if it can.
struct request {
  double tolerance;
  double deadline;  ///< in cpu_seconds()

  /// The rule of methods with a reduced gradient; status `interrupted` at the deadline.
  [[nodiscard]] auto stop() const {
    auto const late = [end = deadline](auto const&) { return cpu_seconds() > end; };
    return slant::reduced_gradient_below(tolerance) ||
           slant::stop_when(late, "the deadline has passed");
  }
};

/// The status of a report as the table writes it.
[[nodiscard]] constexpr std::string_view status_name(slant::status s) {
  return s == slant::status::interrupted ? "time_limit" : to_string(s);
}

/// Products by A, those of the start included.
[[nodiscard]] inline Eigen::Index all_products(slant::work const& w) {
  return w.operator_applications + w.setup_applications;
}

inline void print_precision_header() {
  std::printf(
      "scene,size,unknowns,library,method,formulation,tolerance,seconds,error,products,memory_mib,"
      "linear_solve_seconds,status\n");
}

/// A line of the table; NaN prints as nothing.
struct precision_row {
  std::string library, method, formulation;
  double tolerance = NAN, seconds = NAN, error = NAN, products = NAN, memory_mib = NAN;
  std::string status{};

  void print(row_labels const& labels) const {
    auto const number = [](char const* format, double value) {
      char text[32] = "";
      if (!std::isnan(value)) std::snprintf(text, sizeof text, format, value);
      return std::string(text);
    };
    std::printf("%s,%s,%td,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s\n", labels.scene.c_str(),
                labels.size.c_str(), labels.unknowns, library.c_str(), method.c_str(),
                formulation.c_str(), number("%g", tolerance).c_str(),
                number("%.5g", seconds).c_str(), number("%.3e", error).c_str(),
                number("%.0f", products).c_str(), number("%.1f", memory_mib).c_str(),
                number("%.5g", labels.linear_solve_seconds).c_str(), status.c_str());
    std::fflush(stdout);
  }
};

/// How often and how long.
struct measuring {
  std::vector<double> tolerances{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  int repeats = 5;    ///< of a run that takes at most a second
  double limit = 60;  ///< processor seconds of a run
  double before = 0;  ///< added to all seconds: what was done elsewhere, such as to form A
};

/// Nothing to do once a process before the clock starts.
struct no_preparation {
  void operator()() const {}
};

/// Rows of one method, run(request) → outcome, from loose to tight; prepare(), once in each
/// process, and error(x) are not timed. A tolerance that it does not reach is its last one. Returns
/// the number of rows that converged.
template <class Run, class Error, class Prepare = no_preparation>
int measure_method(precision_row row, row_labels const& labels, measuring const& how,
                   Run const& run, Error const& error, Prepare const& prepare = {}) {
  int good = 0;
  for (double const tolerance : how.tolerances) {
    auto const result = in_child(2 * how.limit + 10, [&] {
      require_fine_clock();
      prepare();
      outcome last;
      double memory = 0;
      double const seconds = median_seconds(how.repeats, 1, [&] {
        last = run(request{tolerance, cpu_seconds() + how.limit});
        if (memory == 0) memory = peak_memory_mib();
      });
      std::vector<double> numbers{seconds, error(last.x), double(last.products), memory};
      for (char const letter : last.status) numbers.push_back(double(letter));
      return numbers;
    });
    row.tolerance = tolerance;
    row.seconds = row.error = row.products = row.memory_mib = NAN;
    row.status = result.how == ending::time_limit ? "time_limit" : "failed";
    if (result.how == ending::finished && result.numbers.size() > 4) {
      row.seconds = result.numbers[0] + how.before;
      row.error = result.numbers[1];
      row.products = result.numbers[2];
      row.memory_mib = result.numbers[3];
      row.status.clear();
      for (std::size_t i = 4; i < result.numbers.size(); ++i)
        row.status.push_back(static_cast<char>(result.numbers[i]));
    }
    row.print(labels);
    if (row.status != "converged") break;
    ++good;
  }
  return good;
}

}  // namespace benchmarks
