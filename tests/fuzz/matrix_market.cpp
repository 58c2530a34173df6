// SPDX-License-Identifier: MIT
//
// Any text as a Matrix Market file: it is refused by bad_input in one printable line, or gives a
// matrix of finite entries that survives being written and read again, in any index type.
#include "bytes.hpp"

#include <slant/io/matrix_market.hpp>

namespace {

using sparse = Eigen::SparseMatrix<double>;

std::string text_of(sparse const& A) {
  std::string text = "%%MatrixMarket matrix coordinate real general\n";
  slant::detail::append_number(text, A.rows());
  slant::detail::append_number(text += ' ', A.cols());
  slant::detail::append_number(text += ' ', A.nonZeros());
  text += '\n';
  for (slant::index j = 0; j < A.outerSize(); ++j)
    for (sparse::InnerIterator e(A, j); e; ++e) {
      slant::detail::append_number(text, e.row() + 1);
      slant::detail::append_number(text += ' ', j + 1);
      slant::detail::append_number(text += ' ', e.value());
      text += '\n';
    }
  return text;
}

bool is_same(sparse const& A, sparse const& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols() || A.nonZeros() != B.nonZeros()) return false;
  for (slant::index j = 0; j < A.outerSize(); ++j)
    for (sparse::InnerIterator a(A, j), b(B, j); a; ++a, ++b)
      if (!b || a.row() != b.row() || a.value() != b.value()) return false;
  return true;
}

/// Parses; false if the text is refused.
template <class S, class I>
bool parse(std::string_view text, Eigen::SparseMatrix<S, Eigen::ColMajor, I>& A) {
  try {
    // Empty rows and columns cost memory, not bytes; the default would cost the fuzzer its speed.
    A = slant::parse_matrix_market<S, I>(text, "A.mtx", {.unbacked_dimension = 4096});
    return true;
  } catch (slant::bad_input const& refusal) {
    fuzz::demand_message(refusal.what());
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  sparse A, again;
  bool const accepted = parse(text, A);
  if (accepted) {
    for (slant::index j = 0; j < A.outerSize(); ++j)
      for (sparse::InnerIterator e(A, j); e; ++e)
        fuzz::demand(std::isfinite(e.value()) && 0 <= e.row() && e.row() < A.rows(),
                     "entries are finite and inside of the matrix");
    std::string_view const banner = text.substr(0, text.find('\n'));
    if (slant::detail::lower_case(banner).find("symmetric") != std::string::npos)
      fuzz::demand(is_same(A, A.transpose()), "a symmetric file gives a symmetric matrix");
    fuzz::demand(parse(text_of(A), again) && is_same(A, again), "the matrix is read again");
  }
  // A narrower scalar and index: more is refused, nothing else is accepted.
  Eigen::SparseMatrix<float, Eigen::ColMajor, short> narrow;
  if (parse(text, narrow)) {
    fuzz::demand(accepted && narrow.rows() == A.rows() && narrow.nonZeros() <= A.nonZeros(),
                 "what short and float can hold, int and double can");
    for (slant::index k = 0; k < narrow.nonZeros(); ++k)
      fuzz::demand(std::isfinite(narrow.valuePtr()[k]), "entries of a float are finite");
  }
  return 0;
}
