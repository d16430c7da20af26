#!/usr/bin/python3
"""Numbers that the normal, Student, chi-square and F distributions give.

In the code: kMedianOfNormal (median of |z| of a normal variable) in lib/robot/compliance_fit.cc; kOutlierTail (both
tails beyond 4) in lib/robot/leave_one_out.cc; kNormal95 in lib/receptance/joint_identification.cc; the two-sided 95 % point in
apps/fit-modes/fit_benchmark.cc; kMedianOfExponential in lib/dynamics/noise.cc is log 2 in words. In the
tests: the quantiles of lib/numerics/distributions_test.cc, three of which (t with 1, 5 and 10 degrees of freedom)
are off in their last digits, by at most 4e-10, within the tests' tolerance of 1e-9. In the manual of
rcsa-couple: 18.9 %, the largest relative deviation r with r <= 0.3 (1 - 1.96 r).

Method: incomplete beta and gamma functions with 30 digits and root finding.
"""
from mpmath import betainc, erfc, exp, findroot, gammainc, log, mp, mpf, nstr, sqrt

from source_check import stands_in, stands_near

mp.dps = 30


def normal_tail(x):
    return erfc(x / sqrt(mpf(2))) / 2


def student_tail(x, dof):
    return betainc(mpf(dof) / 2, mpf(1) / 2, 0, dof / (dof + x * x), regularized=True) / 2


def chi_square_tail(x, dof):
    return gammainc(mpf(dof) / 2, x / 2, regularized=True)


def f_tail(x, numerator, denominator):
    return betainc(mpf(denominator) / 2, mpf(numerator) / 2, 0, denominator / (denominator + numerator * x),
                   regularized=True)


quarter = findroot(lambda x: normal_tail(x) - mpf(1) / 4, 0.67)
two_sided = findroot(lambda x: normal_tail(x) - mpf("0.025"), 1.96)
beyond_four = 2 * normal_tail(mpf(4))
median = f"constexpr double kMedianOfNormal = {nstr(quarter, 4)};"
outlier = f"constexpr double kOutlierTail = {nstr(beyond_four, 2)};"
joint = f"constexpr double kNormal95 = {nstr(two_sided, 3)};"
benchmark = f"{nstr(two_sided, 7)} * deviation.array()"
print("\n".join([median, outlier, joint, benchmark]))
print("one in", nstr(1 / beyond_four, 5), "beyond four deviations")
print("median of a unit exponential:", nstr(findroot(lambda x: exp(-x) - mpf(1) / 2, 0.7), 17),
      "= log 2:", nstr(log(mpf(2)), 17))
largest = mpf("0.3") / (1 + mpf("0.3") * mpf("1.96"))
manual = f"up to {nstr(100 * largest, 3)} %"
print(manual)

tests = []
for dof, start in ((1, 12.7), (2, 4.3), (5, 2.57), (10, 2.23), (30, 2.04)):
    value = findroot(lambda x: student_tail(x, dof) - mpf("0.025"), start)
    tests.append((rf"student_t_quantile\(0.975, {dof}\) == Approx\(([0-9.]+)\)", value))
tests.append((r"normal_cdf\(([0-9.]+)\) == Approx\(0.975\)", two_sided))
five = mpf("0.05")
tests.append((r"chi_square_tail\(([0-9.]+), 10\)", findroot(lambda x: chi_square_tail(x, 10) - five, 18.3)))
tests.append((r"f_tail\(([0-9.]+), 2, 9\)", findroot(lambda x: f_tail(x, 2, 9) - five, 4.26)))
print("for the tests:", "  ".join(nstr(value, 12, strip_zeros=False) for _, value in tests))
print("error: half of the last digit printed")
stands_in("lib/robot/compliance_fit.cc", median)
stands_in("lib/robot/leave_one_out.cc", outlier)
stands_in("lib/receptance/joint_identification.cc", joint)
stands_in("apps/fit-modes/fit_benchmark.cc", benchmark)
stands_in("apps/rcsa-couple/rcsa-couple.1", manual)
stands_near("lib/numerics/distributions_test.cc", 1e-9, *tests)
