// SPDX-License-Identifier: MIT
//
// Contacts with Coulomb friction as a folder of files, contact by contact [n, t₁(, t₂)]:
//
//   W.mtx    n × n    velocities by forces; general or symmetric; n = contacts · dimension
//   q.txt    n        velocities without contact forces
//   mu.txt   a friction coefficient >= 0 for each contact
//
// The dimension, 2 or 3, follows from the sizes.
#pragma once

#include <slant/contact/friction/friction_problem.hpp>
#include <slant/io/atomic_file.hpp>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_vector.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace slant {

struct friction_folder_options {
  contact::asymmetric_data asymmetry = contact::asymmetric_data::used_as_given;
  matrix_market_options W{};  ///< of the matrix
};

namespace detail {

/// Refuses sizes and coefficients by the names of their files.
template <std::floating_point S>
void check_friction_files(std::filesystem::path const& folder,
                          contact::friction_problem<S> const& p) {
  auto const file = [&](char const* name) { return printable(folder / name); };
  index const n = p.q.size(), contacts = p.mu.size();
  if (contacts == 0) throw bad_input(file("mu.txt"), "no number", "one for each contact");
  if (n != 2 * contacts && n != 3 * contacts) {
    throw bad_input(file("q.txt"), show(n) + " numbers",
                    show(2 * contacts) + " (in the plane) or " + show(3 * contacts) +
                        " (in space), for mu.txt has " + show(contacts));
  }
  if (p.W.rows() != n || p.W.cols() != n) {
    throw bad_input(file("W.mtx"),
                    show(index(p.W.rows())) + " rows and " + show(index(p.W.cols())) + " columns",
                    show(n) + " of both, as many as numbers in q.txt");
  }
  for (index i = 0; i < contacts; ++i) {
    if (p.mu[i] < S(0)) {
      throw bad_input(file("mu.txt"), show(p.mu[i]) + " of contact " + show(i), "a number >= 0");
    }
  }
}

}  // namespace detail

/// The texts of the three files.
struct friction_texts {
  std::string_view W, q, mu;
};

/// Parses and checks a problem; the folder names the files in messages, where contacts count from
/// 0. Throws bad_input naming the file (and the line, where it can), what was found and what was
/// expected.
template <std::floating_point S = double>
[[nodiscard]] contact::friction_problem<S> parse_friction_problem(
    friction_texts const& texts, std::filesystem::path const& folder,
    friction_folder_options const& options = {}) {
  contact::friction_problem<S> p;
  p.W = parse_matrix_market<S>(texts.W, detail::printable(folder / "W.mtx"), options.W);
  p.q = parse_text_vector<S>(texts.q, detail::printable(folder / "q.txt"));
  p.mu = parse_text_vector<S>(texts.mu, detail::printable(folder / "mu.txt"));
  detail::check_friction_files(folder, p);
  if (options.asymmetry == contact::asymmetric_data::refused) {
    contact::require_symmetric(detail::printable(folder / "W.mtx"), p.W);
  }
  p.validate();
  return p;
}

/// Reads and checks the problem in a folder. Throws bad_input as parse_friction_problem does.
template <std::floating_point S = double>
[[nodiscard]] contact::friction_problem<S> read_friction_problem(
    std::filesystem::path const& folder, friction_folder_options const& options = {}) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw bad_input(detail::printable(folder), "no folder",
                    "a folder with W.mtx, q.txt and mu.txt");
  }
  std::string const W = detail::read_text_file(folder / "W.mtx");
  std::string const q = detail::read_text_file(folder / "q.txt");
  std::string const mu = detail::read_text_file(folder / "mu.txt");
  return parse_friction_problem<S>({W, q, mu}, folder, options);
}

/// Writes a problem so that reading it gives the same bits; one without contacts is not read.
/// Throws bad_input for one that is not valid or a folder that is not there, std::system_error if
/// there is no room.
template <std::floating_point S>
void write_friction_problem(std::filesystem::path const& folder,
                            contact::friction_problem<S> const& p) {
  p.validate();
  atomic_files files;
  write_matrix_market(files.add(folder / "W.mtx"), p.W);
  write_text_vector(files.add(folder / "q.txt"), p.q);
  write_text_vector(files.add(folder / "mu.txt"), p.mu);
  files.commit();
}

}  // namespace slant
