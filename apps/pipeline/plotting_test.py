#!/usr/bin/python3
"""Tests what the plot scripts share. Run by plots_test.sh with the scripts in PYTHONPATH."""

import math
import random
import unittest

from plotting import grid, lobes, look, place, responses


class Limit(unittest.TestCase):
    def test_a_limit_between_two_stable_speeds_is_a_point_with_ways_out(self):
        entries = [{"speed_rpm": 1, "depth_mm": None}, {"speed_rpm": 2, "depth_mm": 0.5}, {"speed_rpm": 3, "depth_mm": None}]
        rows, leaving, alone = lobes.curve(entries, 4)
        self.assertEqual(rows, [(), (2, 0.5), ()])
        self.assertEqual(alone, [(2, 0.5)])
        self.assertEqual([row for row in leaving if row], [(2, 0.5), (1, 4), (2, 0.5), (3, 4)])

    def test_what_is_not_resolved_is_a_gap_without_a_way_out(self):
        entries = [{"speed_rpm": 1, "depth_mm": None, "not_resolved": "why"}, {"speed_rpm": 2, "depth_mm": 0.5}, {"speed_rpm": 3, "depth_mm": 0.6}]
        rows, leaving, alone = lobes.curve(entries, 4)
        self.assertEqual((rows, leaving, alone), ([(), (2, 0.5), (3, 0.6)], [], []))

    def test_speeds_between_the_charts_are_joined_in_order(self):
        content = {"limit": [{"speed_rpm": 1}, {"speed_rpm": 3}], "what_to_run": {"limit_between": [{"speed_rpm": 2}]}}
        self.assertEqual([entry["speed_rpm"] for entry in lobes.limit(content)], [1, 2, 3])

    def test_a_speed_without_a_limit_has_no_mode(self):
        stable = {"speed_rpm": 1, "depth_mm": None, "mode": None, "table": None, "lobe": None}
        limits = [{"speed_rpm": rpm, "depth_mm": 1, "mode": mode, "table": 2, "lobe": 0} for rpm, mode in ((2, 15), (3, 4))]
        self.assertEqual(lobes.modes([stable, *limits]), ["table 2, mode 4", "table 2, mode 15"])

    def test_each_stretch_with_one_number_of_lobe_is_one(self):
        def entry(depth, lobe, mode):
            return {"depth_mm": depth, "lobe": lobe, "mode": mode, "kind": "hopf"}
        entries = [entry(1, 2, 1), entry(1, 2, 1), entry(None, 2, 1), entry(1, 2, 1), entry(1, 2, 3), entry(1, 1, 3), {"depth_mm": 1}]
        self.assertEqual([(lobe, len(stretch)) for lobe, stretch in lobes.lobes(entries)], [(2, 2), (2, 2), (1, 1)])


class Grid(unittest.TestCase):
    def test_cells_meet_in_the_middle_and_end_with_the_axis(self):
        self.assertEqual(grid.edges([0, 1, 2, 6], (None, None)), [(0, 0.5), (0.5, 1.5), (1.5, 4), (4, 6)])
        self.assertEqual(grid.edges([0, 1, 2, 6], (0.75, 1)), [(None, None), (0.75, 1), (None, None), (None, None)])

    def test_a_raster_fills_the_axis_with_the_nearest_values(self):
        for values, ends in (([0, 1, 2, 3], (0, 3)), ([0, 1, 2, 3], (0.4, 2.2)), ([0, 1, 2, 6], (None, None)), (list(range(900)), (-5, 2000))):
            centres, indices = grid.raster(values, ends)
            low, high = max(values[0], ends[0] or 0), min(values[-1], ends[1] or values[-1])
            half = (centres[1] - centres[0]) / 2
            self.assertAlmostEqual(centres[0] - half, low)
            self.assertAlmostEqual(centres[-1] + half, high)
            for centre, index in zip(centres, indices):
                self.assertAlmostEqual(abs(values[index] - centre), min(abs(value - centre) for value in values))
        self.assertEqual(grid.raster([0, 1, 2, 3], (0, 3))[1], [0, 1, 1, 2, 2, 3])

    def test_ticks_leave_room_for_their_numbers(self):
        for span in (1e-3, 0.7, 12, 5200, 1e6):
            for width in (70, 300, 900):
                self.assertLessEqual(span / grid.ticks((0, span), width) * 62, width)


class Places(unittest.TestCase):
    def test_what_is_placed_is_inside_and_on_nothing(self):
        # Marks at random and at the edges, numbers round them.
        draw = random.Random(5)
        for _ in range(50):
            places = place.Places(400, 200)
            marks = [(draw.uniform(0, 400), draw.uniform(0, 200)) for _ in range(12)] + [(0, 0), (400, 200), (400, 0)]
            for x, y in marks:
                places.take(x, y, 14, 14)
            found = []
            for x, y in marks:
                at = places.find(place.around(x, y, 20, 14), 20, 14)
                if at:
                    found.append((at[0] - 10, at[0] + 10, at[1] - 7, at[1] + 7))
            self.assertGreater(len(found), 5)
            boxes = found + [(x - 7, x + 7, y - 7, y + 7) for x, y in marks]
            for i, (left, right, bottom, top) in enumerate(found):
                self.assertTrue(left >= 0 and right <= 400 and bottom >= 0 and top <= 200)
                for other in boxes[i + 1:]:
                    self.assertTrue(left >= other[1] or other[0] >= right or bottom >= other[3] or other[2] >= top)

    def test_what_lies_on_the_edge_is_inside(self):
        places = place.Places(0.1 + 0.2, 1)
        self.assertTrue(places.inside(0.3, 1, 0, 0))
        self.assertTrue(place.Places(0.3, 1).inside(0.1 + 0.2, 0, 0, 0))
        self.assertFalse(places.inside(0.31, 1, 0, 0))

    def test_a_line_is_taken_along_its_way_but_not_over_gaps(self):
        places = place.Places(100, 100)
        places.take_line([(0, 50), (50, 50), None, (80, 50)])
        self.assertFalse(places.free(25, 50, 4, 4))
        self.assertTrue(places.free(65, 50, 4, 4))


class Look(unittest.TestCase):
    def test_the_colours_can_be_told_apart_in_grey(self):
        def lightness(colour):
            red, green, blue = (int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5))
            linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (red, green, blue)]
            luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
            return 116 * luminance ** (1 / 3) - 16 if luminance > 0.008856 else 903.3 * luminance
        steps = [lightness(colour) for colour in look.SERIES]
        # Five is twice what the eye tells from each other in one place.
        self.assertTrue(all(after - before > 5 for before, after in zip(steps, steps[1:])), steps)

    def test_a_text_cannot_leave_its_quotes(self):
        for sign in "'\"`\\\n\t$@{}!;&~#\x00\u2028":
            self.assertEqual(look.clean(f"a{sign}b"), "a?b")
        self.assertEqual(look.clean("Fräser_2 µm ±3 °"), "Fräser_2 µm ±3 °")

    def test_only_numbers_are_data(self):
        self.assertEqual(look.number(None), "NaN")
        self.assertEqual(float(look.number(0.1)), 0.1)
        with self.assertRaises(ValueError):
            look.number("system(1)")


class Responses(unittest.TestCase):
    entry = {"response": "x", "reference": "y", "re": [1.0, 2.0], "im": [0.5, -1.0], "variance": [4.0, 4.0]}

    def content(self, quantity):
        return {"quantity": quantity, "frequency_hz": [0.0, 10.0]}

    def test_each_step_is_a_derivative_and_back(self):
        omega = 20 * math.pi
        up = responses.curve("", self.content("receptance"), self.entry, self.entry, "accelerance")
        self.assertAlmostEqual(abs(up.values[1] - (2 - 1j) * -omega ** 2), 0, delta=1e-9 * omega ** 2)
        self.assertAlmostEqual(up.deviation[1], 2 * omega ** 2, delta=1e-9 * omega ** 2)
        down = responses.curve("", self.content("mobility"), self.entry, self.entry, "receptance")
        self.assertIsNone(down.values[0])
        self.assertAlmostEqual(abs(down.values[1] - (2 - 1j) / (1j * omega)), 0, delta=1e-15)

    def test_a_minus_turns_the_sign(self):
        turned = responses.curve("", self.content("mobility"), self.entry | {"response": "-x"}, self.entry, "mobility")
        self.assertEqual(turned.values, [-1 - 0.5j, -2 + 1j])

    def test_no_line_where_a_phase_goes_round(self):
        self.assertEqual(responses.rows([1, 2, 3], [179, -179, -178], 180), [(1, 179), (), (2, -179), (3, -178)])

    def test_nothing_is_clipped(self):
        low, high = responses.extent([([1, 2, 3], [1e-9, 0, 1e-3])], 1, 3, True)
        self.assertTrue(0 < low < 1e-9 and high > 1e-3)

    def test_names_by_what_made_them(self):
        made = {"tool": "fit-modes", "arguments": ["--synthesize", "1:2:3"], "inputs": []}
        converted = {"tool": "fit-modes", "arguments": ["--convert"], "inputs": [{"name": "a", "from": made}]}
        self.assertEqual([responses.origin(one) for one in (made, converted, converted | {"inputs": [{"name": "a"}]}, {"tool": "rcsa-couple"}, None)],
                         ["synthesized", "synthesized", "measured", "computed", None])


unittest.main(argv=["plotting_test"], verbosity=0)
