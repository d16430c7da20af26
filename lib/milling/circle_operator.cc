#include "milling/circle_operator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "milling/arc_polynomials.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// What multiplies a part at an angle.
Complex scale_of(const CircleOperator& of, const CircleOperator::Part& part, double angle) {
  const Complex delayed = std::polar(1.0, -part.delay * angle);
  return of.plain ? delayed * (1.0 - std::polar(1.0, -angle)) : delayed;
}

// (mu - free flight)^-1 times columns of real states, or its adjoint.
Eigen::MatrixXcd resolvent_times(const CircleOperator& of, double angle, bool adjoint,
                                 const Eigen::MatrixXcd& states) {
  const Eigen::Index modes = of.growth.size();
  const Complex mu = std::polar(1.0, angle), i(0, 1);
  Eigen::MatrixXcd result(states.rows(), states.cols());
  for (Eigen::Index k = 0; k < modes; ++k) {
    const Complex first = 1.0 / (mu - of.growth[k]), second = 1.0 / (mu - std::conj(of.growth[k]));
    Complex a = (first + second) / 2.0, b = (first - second) / (2.0 * i);
    if (adjoint) {
      a = std::conj(a);
      b = -std::conj(b);
    }
    result.row(k) = a * states.row(k) - b * states.row(modes + k);
    result.row(modes + k) = b * states.row(k) + a * states.row(modes + k);
  }
  return result;
}

}  // namespace

Eigen::Index CircleOperator::most() const {
  Eigen::Index longest = 0;
  for (const RowPolynomial& row : polynomials) longest = std::max(longest, row.degree + 1);
  return longest;
}

std::vector<Eigen::Index> CircleOperator::rows_of(Eigen::Index count) const {
  const std::vector<Eigen::Index> counts = polynomials_on(arc_length, count);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index r = 0; r < size(); ++r) {
    if (polynomials[r].degree < counts[polynomials[r].arc]) rows.push_back(r);
  }
  return rows;
}

Eigen::MatrixXcd CircleOperator::matrix(double angle) const {
  const Eigen::MatrixXcd states = resolvent_times(*this, angle, false, state_of.cast<Complex>());
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(size(), size());
  for (const Part& part : parts) {
    Eigen::MatrixXd re = part.direct, im = Eigen::MatrixXd::Zero(size(), size());
    if (part.of_state.cols() > 0) {
      re.noalias() += part.of_state * states.real();
      im.noalias() += part.of_state * states.imag();
    }
    result += scale_of(*this, part, angle) * (re + Complex(0, 1) * im);
  }
  return result;
}

Eigen::MatrixXcd CircleOperator::times(double angle, const Eigen::MatrixXcd& columns) const {
  const Eigen::MatrixXcd states = resolvent_times(*this, angle, false, state_of * columns);
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(columns.rows(), columns.cols());
  for (const Part& part : parts) {
    Eigen::MatrixXcd felt = part.direct * columns;
    if (part.of_state.cols() > 0) felt += part.of_state * states;
    result += scale_of(*this, part, angle) * felt;
  }
  return result;
}

Eigen::MatrixXcd CircleOperator::adjoint_times(double angle, const Eigen::MatrixXcd& columns) const {
  Eigen::MatrixXcd states = Eigen::MatrixXcd::Zero(state_of.rows(), columns.cols());
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(columns.rows(), columns.cols());
  for (const Part& part : parts) {
    const Eigen::MatrixXcd scaled = std::conj(scale_of(*this, part, angle)) * columns;
    result += part.direct.transpose() * scaled;
    if (part.of_state.cols() > 0) states += part.of_state.transpose() * scaled;
  }
  return result + state_of.transpose() * resolvent_times(*this, angle, true, states);
}

PeriodForce period_force(const TipStructure& structure, const Collocation& c, double period_s) {
  PeriodForce force{{}, c.nodes, c.lift};
  CircleOperator& result = force.whole;
  Eigen::MatrixXd& lift = force.lift;
  result.parts = {{0, c.difference_of_drive, c.difference_of_state}};
  result.state_of = c.final_of_drive;
  result.growth = (structure.lambda * period_s).array().exp();
  result.polynomials = c.polynomials;
  result.arc_length = arc_lengths(c);
  result.plain = c.remembered_count == result.size();
  if (result.plain) return force;
  // A velocity is compared with nothing.
  CircleOperator::Part before{1, -c.sensed_of_drive, -c.sensed_of_state};
  for (Eigen::Index r = 0; r < result.size(); ++r) {
    if (c.rows[r].remembered >= 0) continue;
    before.direct.row(r).setZero();
    before.of_state.row(r).setZero();
  }
  result.parts.push_back(std::move(before));
  // Velocities times a time, so that they have the size of displacements.
  for (Eigen::Index r = 0; r < result.size(); ++r) {
    if (c.rows[r].remembered >= 0) continue;
    for (CircleOperator::Part& part : result.parts) {
      part.direct.row(r) *= period_s;
      part.direct.col(r) /= period_s;
      part.of_state.row(r) *= period_s;
    }
    result.state_of.col(r) /= period_s;
    lift.col(r) /= period_s;
  }
  return force;
}

CircleOperator chosen_rows(const CircleOperator& whole, const std::vector<Eigen::Index>& rows) {
  CircleOperator result;
  for (const CircleOperator::Part& part : whole.parts) {
    result.parts.push_back({part.delay, part.direct(rows, rows), {}});
    if (part.of_state.cols() > 0) result.parts.back().of_state = part.of_state(rows, Eigen::all);
  }
  result.state_of = whole.state_of(Eigen::all, rows);
  result.growth = whole.growth;
  result.plain = whole.plain;
  for (const Eigen::Index row : rows) result.polynomials.push_back(whole.polynomials[row]);
  result.arc_length = whole.arc_length;
  return result;
}

PeriodForce with_fewer(const PeriodForce& force, Eigen::Index most) {
  const std::vector<Eigen::Index> rows = force.whole.rows_of(most);
  return {chosen_rows(force.whole, rows), force.nodes, force.lift(Eigen::all, rows)};
}

CircleOperator projected(const CircleOperator& whole, const Eigen::MatrixXd& basis) {
  CircleOperator result;
  for (const CircleOperator::Part& part : whole.parts) {
    result.parts.push_back({part.delay, basis.transpose() * part.direct * basis, {}});
    if (part.of_state.cols() > 0) result.parts.back().of_state = basis.transpose() * part.of_state;
  }
  result.state_of = whole.state_of * basis;
  result.growth = whole.growth;
  result.plain = whole.plain;
  return result;
}

}  // namespace stablecut::milling
