"""Helpers of the command-line tests in Python: a count of checks, and 4 x 4 matrices as lists of rows."""

passed = failed = 0


def check(name, holds, what=""):
    global passed, failed
    if holds:
        passed += 1
    else:
        failed += 1
        print(f"FAILED: {name}: {what}")


def finish():
    print(f"{passed} passed, {failed} failed")
    raise SystemExit(failed > 0 or passed == 0)


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
