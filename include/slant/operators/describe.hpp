// SPDX-License-Identifier: MIT
//
// describe(A): the tree of an expression with sizes, laws, bytes of workspace, what was counted and
// timed, and for a missing law the part that breaks it.
#pragma once

#include <slant/operators/explain.hpp>

#include <boost/hana/for_each.hpp>

#include <ranges>
#include <string>
#include <tuple>

namespace slant {

namespace expr {

template <std::size_t>
struct anything {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};
template <class W, std::size_t N>
inline constexpr bool has_fields = []<std::size_t... I>(std::index_sequence<I...>) {
  return requires { W{anything<I>()...}; };
}(std::make_index_sequence<N>{});

template <class T>
inline constexpr bool is_hana_tuple = false;
template <class... T>
inline constexpr bool is_hana_tuple<hana::tuple<T...>> = true;

/// Bytes of the vectors that a workspace holds, however deep: of ranges, and of aggregates of up to
/// eight members; 0 of larger ones, and of what any_operator hides.
template <class W>
[[nodiscard]] std::size_t bytes_of(W const& w) {
  auto const all = [](auto const&... part) {
    return (std::size_t(0) + ... + expr::bytes_of(part));
  };
  if constexpr (requires { typename W::Scalar; }) {
    return sizeof(typename W::Scalar) * static_cast<std::size_t>(w.size());
  } else if constexpr (requires { w.local(); }) {
    return expr::bytes_of(w.local());
  } else if constexpr (is_hana_tuple<W>) {
    return hana::unpack(w, all);
  } else if constexpr (std::ranges::range<W const>) {
    std::size_t sum = 0;
    for (auto const& part : w) sum += expr::bytes_of(part);
    return sum;
  } else if constexpr (requires { std::tuple_size<W>::value; }) {
    return std::apply(all, w);
  } else if constexpr (std::is_empty_v<W> || !std::is_aggregate_v<W>) {
    return 0;
  } else if constexpr (has_fields<W, 9>) {
    return 0;
  } else if constexpr (has_fields<W, 8>) {
    auto const& [a, b, c, d, e, f, g, h] = w;
    return all(a, b, c, d, e, f, g, h);
  } else if constexpr (has_fields<W, 7>) {
    auto const& [a, b, c, d, e, f, g] = w;
    return all(a, b, c, d, e, f, g);
  } else if constexpr (has_fields<W, 6>) {
    auto const& [a, b, c, d, e, f] = w;
    return all(a, b, c, d, e, f);
  } else if constexpr (has_fields<W, 5>) {
    auto const& [a, b, c, d, e] = w;
    return all(a, b, c, d, e);
  } else if constexpr (has_fields<W, 4>) {
    auto const& [a, b, c, d] = w;
    return all(a, b, c, d);
  } else if constexpr (has_fields<W, 3>) {
    auto const& [a, b, c] = w;
    return all(a, b, c);
  } else if constexpr (has_fields<W, 2>) {
    auto const& [a, b] = w;
    return all(a, b);
  } else {
    auto const& [a] = w;
    return all(a);
  }
}

/// What the object behind a letter can tell of itself.
template <class A>
[[nodiscard]] std::string letter_details(A const& object) {
  std::string out = ", " + std::string(type_name<A>());
  if constexpr (requires { object.applications(); }) {
    out += ", " + std::to_string(object.applications()) + " applications";
  }
  if constexpr (requires { number_text(object.seconds()); }) {
    out += ", " + number_text(object.seconds()) + " s";
  }
  if constexpr (requires { object.get().nonZeros(); }) {
    out += ", " + std::to_string(object.get().nonZeros()) + " entries";
  }
  return out;
}

/// Appends the tree of A; head stands before its own line, indent before those below.
template <class V, class A>
void draw_tree(A const& a, std::string const& head, std::string const& indent, std::string& out) {
  static constexpr law_set wanted = slant::laws<law::self_adjoint, law::positive_definite>;
  static constexpr ascii why = missing_law<A>(wanted);

  out += head;
  expr::print_part(a, out);
  out += "   " + std::to_string(a.rows()) + " × " + std::to_string(a.cols()) + ", ";
  out += laws_text(laws_of<A>);
  if constexpr (linear_operator<A, V>) {
    std::size_t const bytes = expr::bytes_of(slant::workspace(a, slant::like(V(), a.cols())));
    if (bytes > 0) out += ", workspace " + std::to_string(bytes) + " bytes";
  } else {
    out += ", cannot be applied to these vectors";
  }
  if constexpr (is_letter<A>) out += expr::letter_details(*a.object());
  out += "\n";
  if (!is_letter<A> && why.size > 0 && a.rows() == a.cols()) {
    out.append(indent).append("│  ").append(why.view()).append("\n");
  }

  auto const draw_parts = [&](auto const& parts) {
    std::size_t left = hana::unpack(parts, [](auto const&... p) { return sizeof...(p); });
    hana::for_each(parts, [&](auto const& part) {
      bool const end = --left == 0;
      expr::draw_tree<V>(part, indent + (end ? "└─ " : "├─ "), indent + (end ? "   " : "│  "), out);
    });
  };
  if constexpr (requires { a.factors(); }) {
    draw_parts(a.factors());
  } else if constexpr (requires { a.terms(); }) {
    draw_parts(a.terms());
  } else if constexpr (expression<decltype(a.get())>) {
    expr::draw_tree<V>(a.get(), indent + "└─ ", indent + "   ", out);
  }
}

}  // namespace expr

/// The tree of A for vectors of type V, a line for each part.
template <class V = Eigen::VectorXd, expression A>
[[nodiscard]] std::string describe(A const& a) {
  std::string out;
  expr::draw_tree<V>(a, "", "", out);
  return out;
}
/// Of an operator that is no expression: its line.
template <class V = Eigen::VectorXd, linear_term A>
  requires(!expression<A>)
[[nodiscard]] std::string describe(A const& a) {
  return slant::describe<V>(expr::as_expression(a));
}

}  // namespace slant
