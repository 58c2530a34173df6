// SPDX-License-Identifier: MIT
//
// Every letter with every other, a b, a + b, a − b with numbers in front, a b c, a b + c and
// palindromes of five: each inferred law holds for the dense matrix. Letters are in general position,
// so a law that does not follow from the structure does not hold by accident either.
#include <boost/hana/for_each.hpp>
#include <support/testing.hpp>
#include "operators/letters.hpp"

namespace expressions_test {

namespace hana = boost::hana;

/// An expression and its matrix.
template <class A>
struct sample {
  A a;
  MatrixXd m;
};
template <class A>
sample(A, MatrixXd) -> sample<A>;

template <class A>
[[nodiscard]] auto transposed(sample<A> const& s) {
  return sample{adjoint(s.a), MatrixXd(s.m.transpose())};
}

struct tally {
  int expressions = 0, with_laws = 0;

  void judge(slant::law_set laws, std::string const& text, MatrixXd const& m) {
    INFO(text);
    CHECK(test::false_laws(m, laws) == "");
    ++expressions;
    if (laws.bits != 0) ++with_laws;
  }
  template <class A>
  void operator()(A const& a, MatrixXd const& m) {
    judge(slant::laws_of<A>, to_string(a), m);
  }
};

TEST_CASE("every letter with every other: no false law") {
  SLANT_TEST_LETTERS;
  MatrixXd const Dm = o.d.asDiagonal();
  auto const letters = hana::make_tuple(
      sample{S, o.S}, sample{P, o.P}, sample{Q, o.Q}, sample{G, o.G},
      sample{adjoint(G), MatrixXd(o.G.transpose())}, sample{T, o.T},
      sample{adjoint(T), MatrixXd(o.T.transpose())}, sample{J, o.J},
      sample{Kinv, MatrixXd(o.K.inverse())}, sample{+I, MatrixXd(MatrixXd::Identity(n, n))},
      sample{inverse(op<"D">(D)), MatrixXd(Dm.inverse())});
  tally see;
  hana::for_each(letters, [&](auto const& a) {
    see(a.a, a.m);
    see(-a.a, -a.m);
    see(2.0 * a.a, 2 * a.m);
    see(slant::any_sign(2.0) * a.a, 2 * a.m);
    hana::for_each(letters, [&](auto const& b) {
      see(a.a * b.a, a.m * b.m);
      see(a.a + b.a, a.m + b.m);
      see(a.a - b.a, a.m - b.m);
    });
  });
  CHECK(see.expressions == 407);
  CHECK(see.with_laws >= 180);
}

TEST_CASE("expressions of three letters, and palindromes: no false law") {
  SLANT_TEST_LETTERS;
  auto const letters = hana::make_tuple(
      sample{S, o.S}, sample{P, o.P}, sample{Q, o.Q}, sample{G, o.G},
      sample{adjoint(G), MatrixXd(o.G.transpose())}, sample{T, o.T}, sample{J, o.J});
  tally see;
  hana::for_each(letters, [&](auto const& a) {
    hana::for_each(letters, [&](auto const& b) {
      auto const bt = transposed(b);
      auto const at = transposed(a);
      see((a.a + b.a) * a.a * adjoint(a.a + b.a), (a.m + b.m) * a.m * (a.m + b.m).transpose());
      see(a.a * (b.a + a.a) * at.a, a.m * (b.m + a.m) * at.m);
      see(2.0 * (a.a * b.a + adjoint(a.a * b.a)) - a.a,
          2 * (a.m * b.m + (a.m * b.m).transpose()) - a.m);
      see(a.a * b.a * a.a * bt.a * at.a, a.m * b.m * a.m * bt.m * at.m);
      hana::for_each(letters, [&](auto const& c) {
        see(a.a * b.a * c.a, a.m * b.m * c.m);
        see(a.a * b.a + c.a, a.m * b.m + c.m);
      });
    });
  });
  CHECK(see.expressions == 882);
  CHECK(see.with_laws >= 180);
}

}  // namespace expressions_test
