#!/usr/bin/python3
"""pi/2 in three parts: kHigh, kMiddle, kLow in lib/numerics/elementary_lanes.h (sines_and_cosines).

Cody and Waite's reduction: kHigh is pi/2 cut off after its first 33 bits, kMiddle the next 33 bits of what is
left, kLow the rest rounded to double. A whole number below 2^20 times either of the first two has at most 53
bits, so that these products are exact, and x - k kHigh is exact too. (The same three numbers stand in
fdlibm's e_rem_pio2.c as pio2_1, pio2_2 and pio2_2t.)

Prints the parts as they stand in the code, and the largest error of the reduced angle for |angle| < 1e5 rad.
"""
import random

from mpmath import floor, mp, mpf, nstr, pi

from source_check import stands_in

mp.dps = 60
BITS = 33


def cut_off(value):
    """The number of that many leading bits at or below the value."""
    exponent = mp.mag(value) - 1  # value in [2^exponent, 2^(exponent + 1))
    unit = mpf(2) ** (exponent - BITS + 1)
    return floor(value / unit) * unit


def hexadecimal(value):
    mantissa, exponent = float(value).hex().split("p")
    return mantissa.rstrip("0") + "p" + exponent


high = cut_off(pi / 2)
middle = cut_off(pi / 2 - high)
low = mpf(float(pi / 2 - high - middle))
names = {"kHigh": high, "kMiddle": middle, "kLow": low}
text = "constexpr double " + ", ".join(f"{name} = {hexadecimal(part)}" for name, part in names.items()) + ";"
print(text)
print("what the three parts leave of pi/2:", nstr(pi / 2 - high - middle - low, 3))

# In double, as the code does it.
generator = random.Random(1)
worst = mpf(0)
for _ in range(20000):
    x = generator.uniform(-1e5, 1e5)
    k = float(round(x * (2 / float(pi))))
    r = ((x - k * float(high)) - k * float(middle)) - k * float(low)
    worst = max(worst, abs(mpf(r) - (mpf(x) - mpf(k) * pi / 2)))
print("largest error of the reduced angle, 20 000 random angles below 1e5 rad:", nstr(worst, 3))
stands_in("lib/numerics/elementary_lanes.h", text)
