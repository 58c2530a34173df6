// SPDX-License-Identifier: MIT
//
// Static condensation by CHOLMOD: choice of the ordering, and the part of the factor that contact
// unknowns reach, packed.
#pragma once

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

#include <slant/base/matrix_entries.hpp>
#include <slant/factorizations/cholmod.hpp>
#include <slant/factorizations/condensation_options.hpp>
#include <slant/factorizations/condensed_operator.hpp>
#include <slant/factorizations/fill_estimate.hpp>
#include <slant/factorizations/parts/contact_ordering.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>
#include <slant/factorizations/parts/tail.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::detail {

/// Ordering of a symmetric matrix by CHOLMOD, its elimination tree and the lengths of the columns
/// of its factor; no number of that is computed.
class cholmod_ordering {
 public:
  /// Nested dissection (METIS) where CHOLMOD has it, else minimum degree; postordered.
  explicit cholmod_ordering(cholmod_sparse& matrix) : cholmod_ordering(matrix.nrow) {
    cholmod_state state;
    state.get()->supernodal = CHOLMOD_SIMPLICIAL;  // enough for an ordering
    state.get()->nmethods = 1;
    state.get()->method[0].ordering = CHOLMOD_METIS;
    cholmod_factor* found = cholmod_analyze(&matrix, state.get());
    if (found == nullptr) {
      state.get()->method[0].ordering = CHOLMOD_AMD;
      found = cholmod_analyze(&matrix, state.get());
    }
    if (found == nullptr) throw std::bad_alloc();
    auto const* permutation = static_cast<int const*>(found->Perm);
    order_.assign(permutation, permutation + found->n);
    cholmod_free_factor(&found, state.get());
    analyze(matrix, state);
  }
  /// This ordering (position → unknown).
  cholmod_ordering(cholmod_sparse& matrix, std::vector<int> order) : cholmod_ordering(matrix.nrow) {
    order_ = std::move(order);
    cholmod_state state;
    analyze(matrix, state);
  }

  [[nodiscard]] std::vector<int> const& order() const noexcept { return order_; }
  [[nodiscard]] std::vector<int> const& parent() const noexcept { return parent_; }

  /// What factoring costs, and applications from marked unknowns to marked ones, if each vertex of
  /// the graph stands for so many unknowns. contact: the unknowns of the marked vertices that are
  /// meant.
  [[nodiscard]] condensation_plan plan(index levels, std::vector<char> const& marked, double weight,
                                       double contact) const {
    condensation_plan p;
    p.levels = levels;
    p.contact = contact;
    double vertices = 0, skipped = 0;  // marked ones; entries before them
    p.stored = upper_halves(weight);
    std::vector<char> reached(order_.size(), 0);
    for (std::size_t j = 0; j < order_.size(); ++j) {
      double const rows = weight * length_[j];  // of the first of its columns
      double const entries = weight * (rows - (weight - 1) / 2);
      p.flops += weight * (rows - (weight - 1) / 2) * (rows - (weight - 1) / 2);
      p.entries += entries;
      p.stored += entries;
      if (marked[static_cast<std::size_t>(order_[j])] != 0) {
        reached[j] = 1;
        vertices += 1;
        skipped += p.tail_entries;
      }
      if (reached[j] == 0) continue;
      p.tail += weight;
      p.tail_entries += entries;
      if (parent_[j] >= 0) reached[static_cast<std::size_t>(parent_[j])] = 1;
    }
    if (vertices > 0) p.forming = 4 * contact * (p.tail_entries - skipped / vertices);
    return p;
  }

 private:
  explicit cholmod_ordering(std::size_t n) : order_(n), parent_(n), length_(n) {}

  /// Entries above the diagonals of supernodes, which are stored as full matrices: chains of
  /// columns each of which has the rows of the one before.
  [[nodiscard]] double upper_halves(double weight) const {
    std::vector<int> children(order_.size(), 0), chain(order_.size(), 1);
    for (int const p : parent_) {
      if (p >= 0) ++children[static_cast<std::size_t>(p)];
    }
    double sum = 0;
    for (std::size_t j = 0; j < order_.size(); ++j) {
      auto const p = static_cast<std::size_t>(parent_[j]);
      if (parent_[j] >= 0 && children[p] == 1 && length_[p] + 1 == length_[j]) {
        chain[p] = chain[j] + 1;
      } else {
        double const columns = weight * chain[j];
        sum += columns * (columns - 1) / 2;
      }
    }
    return sum;
  }

  void analyze(cholmod_sparse& matrix, cholmod_state& state) {
    std::size_t const n = order_.size();
    std::vector<int> post(n), first(n), level(n);
    if (cholmod_analyze_ordering(&matrix, CHOLMOD_GIVEN, order_.data(), nullptr, 0, parent_.data(),
                                 post.data(), length_.data(), first.data(), level.data(),
                                 state.get()) == 0) {
      throw std::bad_alloc();
    }
  }

  std::vector<int> order_;   // position → unknown
  std::vector<int> parent_;  // of each column, −1 for roots
  std::vector<int> length_;  // entries of each column of L, its diagonal included
};

/// See static_condensation.hpp. S: double; a template, so that only who condenses compiles it.
template <class S>
class cholmod_condensation {
 public:
  using sparse_type = Eigen::SparseMatrix<S>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  cholmod_condensation(auto const& matrix, std::vector<char> marked,
                       condensation_options const& options)
      : marked_(std::move(marked)),
        factor_(matrix, best_order(matrix, marked_, options, planned_)),
        tail_(reached_part()) {
    form(matrix);
  }

  [[nodiscard]] cholmod_condensation refactorized(auto const& matrix) const {
    cholmod_condensation result = *this;
    result.factor_ = factor_.refactorized(matrix);
    result.tail_ = result.reached_part();
    result.form(matrix);
    return result;
  }

  [[nodiscard]] index rows() const { return factor_.rows(); }
  [[nodiscard]] std::string_view name() const noexcept { return factor_.name(); }
  [[nodiscard]] condensation_report const& report() const noexcept { return report_; }

  [[nodiscard]] cholmod_workspace workspace(auto const& b) const { return factor_.workspace(b); }
  void solve(auto const& b, auto& x, cholmod_workspace& w) const { factor_.solve(b, x, w); }
  void solve(auto const& b, auto& x) const { factor_.solve(b, x); }

  /// B touches marked unknowns only.
  [[nodiscard]] auto restricted(sparse_type const& b) const {
    if (inverse_) {
      return condensed_operator<S>(columns_of(b, contact_unknowns()), inverse_, factor_.unit());
    }
    return condensed_operator<S>(columns_of(b, unknowns_), tail_, factor_.unit());
  }

 private:
  static std::shared_ptr<sparse_type const> columns_of(sparse_type const& b,
                                                       std::vector<index> const& unknowns) {
    sparse_type const columns = b * columns_of_identity<S>(b.cols(), unknowns);
    return std::make_shared<sparse_type>(columns.pruned());
  }

  static std::vector<int> best_order(auto const& matrix, std::vector<char> const& marked,
                                     condensation_options const& options,
                                     condensation_report& report) {
    require_square("K", matrix);
    if (matrix.rows() == 0) return {};
    quotient_graph const quotient(matrix);
    cholmod_sparse view = cholmod_view(quotient.graph());
    cholmod_ordering const given(view);
    separator_tree const separators(given.parent());
    std::vector<char> const groups = quotient.groups(marked);
    double const weight = static_cast<double>(matrix.rows()) / quotient.size();
    auto const order_of = [&](index levels) {
      return postponed(given.order(), groups, separators.subtrees(levels));
    };
    // More levels cost ever less to factor and keep, and ever more to apply: the best one is before
    // times rise, if memory allows it.
    auto& plans = report.plans;
    auto const contact = static_cast<double>(std::ranges::count_if(marked, std::identity{}));
    report.alone = given.plan(0, groups, weight, contact);
    report.alone.predict(options);
    index const first = options.levels.value_or(0);
    int rises = 0;
    bool found = false;
    for (index levels = first; rises < 2 || !found; ++levels) {
      plans.push_back(
          cholmod_ordering(view, order_of(levels)).plan(levels, groups, weight, contact));
      plans.back().predict(options);
      found = found || fits(plans.back(), report.alone, options);
      if (plans.size() > 1 && plans.back().seconds >= plans[plans.size() - 2].seconds) ++rises;
      if (options.levels || separators.subtrees(levels).empty()) break;
    }
    std::vector<condensation_plan> const swept = plans;
    if (options.inverse == true) plans.clear();
    if (options.inverse != false) {
      for (auto const& plan : swept) plans.push_back(plan.with_inverse(options));
    }
    report.chosen = cheapest(plans, report.alone, options);
    report.reason = "least time predicted among " + show(static_cast<index>(plans.size())) +
                    " ways, that with contact unknowns behind the subdomains of level " +
                    show(report.chosen.levels) +
                    (report.chosen.inverse ? ", and the inverse on them formed" : "");
    if (options.levels && options.inverse) report.reason = "as asked for";
    return quotient.expanded(order_of(report.chosen.levels));
  }

  /// Numbers the columns that marked unknowns reach.
  std::shared_ptr<tail_columns const> reached_part() {
    auto shape = std::make_shared<tail_shape>();
    unknowns_.clear();
    std::vector<tail_columns::matrix> parts;
    if (rows() > 0) {
      auto const& factors = *factor_.handle();
      std::vector<int> const order = factors.order();
      // A column that is reached reaches the first row below it, and with a column of a supernode
      // all that follow it.
      std::vector<char> reached(marked_.size(), 0);
      std::vector<int> number(marked_.size(), -1);
      std::vector<typename cholmod_factors::supernode> nodes;  // their columns that are reached
      factors.for_each_supernode([&](cholmod_factors::supernode const& s) {
        index from = s.first;
        index const end = s.first + s.columns;
        while (from < end && reached[static_cast<std::size_t>(from)] == 0 &&
               marked_[static_cast<std::size_t>(order[static_cast<std::size_t>(from)])] == 0) {
          ++from;
        }
        if (from == end) return;
        for (index j = from; j < end; ++j) {
          number[static_cast<std::size_t>(j)] = static_cast<int>(unknowns_.size());
          unknowns_.push_back(order[static_cast<std::size_t>(j)]);
        }
        if (s.height > s.columns) reached[static_cast<std::size_t>(s.rows[s.columns])] = 1;
        index const skipped = from - s.first;
        nodes.push_back({from, s.columns - skipped, s.height - skipped, s.rows + skipped,
                         s.entries + skipped * (s.height + 1)});
        parts.push_back({nodes.back().entries, s.height});
      });
      std::vector<int> below;
      for (auto const& s : nodes) {
        below.assign(s.rows + s.columns, s.rows + s.height);
        for (int& row : below) row = number[static_cast<std::size_t>(row)];
        shape->add(s.columns, below);
      }
    }
    return std::make_shared<tail_columns>(std::move(shape), parts, factor_.handle());
  }

  [[nodiscard]] bool is_contact(index unknown) const {
    return marked_[static_cast<std::size_t>(unknown)] != 0;
  }
  /// The contact unknowns in the order of the tail.
  [[nodiscard]] std::vector<index> contact_unknowns() const {
    std::vector<index> result;
    std::ranges::copy_if(unknowns_, std::back_inserter(result),
                         [this](index j) { return is_contact(j); });
    return result;
  }

  /// Forms S⁻¹ if the plan has it, and keeps it if it is good for floats.
  void form(sparse_type const& matrix) {
    report_ = planned_;
    inverse_.reset();
    if (!report_.chosen.inverse) return;
    std::vector<int> numbers;
    std::vector<S> stiffness;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      index const j = unknowns_[i];
      if (!is_contact(j)) continue;
      numbers.push_back(static_cast<int>(i));
      stiffness.push_back(matrix.coeff(j, j) * factor_.unit());
    }
    inverse_ = tail_inverse(*tail_, numbers);
    if (stays_definite<float>(*inverse_, stiffness)) return;
    inverse_.reset();
    report_.chosen.inverse = false;
    report_.reason += "; but not kept, because floats would make it indefinite";
  }

  std::vector<char> marked_;
  condensation_report planned_;  // before it was known whether the inverse is any good
  condensation_report report_;
  cholmod factor_;
  std::vector<index> unknowns_;  // of the tail
  std::shared_ptr<tail_columns const> tail_;
  std::shared_ptr<packed_symmetric<S> const> inverse_;  // on contact unknowns; may be missing
};

}  // namespace slant::detail

#endif
