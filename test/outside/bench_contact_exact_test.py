#!/usr/bin/python3
"""forming_bench contact exact on short problems: rows, files, and what physics says of the errors.

usage: bench_contact_exact_test.py FORMING_BENCH
"""
import csv
import os
import sys
import unittest

from bench_run import BenchRun, run_bench


class ContactExact(BenchRun):
    words = ('contact', 'exact', 'bounce', 'bars')

    def test_the_end_of_the_step_is_of_first_order(self):
        """Least gap and rebound of the mass that bounces on the layer, by the implicit method."""
        for quantity in ('order of least gap / h0', 'order of rebound'):
            orders = {case: row for case, row in self.of_case(quantity).items() if 'implicit' in case}
            self.assertGreater(len(orders), 8)
            for case, row in orders.items():
                self.assertAlmostEqual(row['found'], 1, delta=0.05, msg=case)

    def test_what_contact_takes_from_a_bar_falls_with_the_cell(self):
        orders = self.of_case('order of energy / at the start')
        self.assertEqual(len(orders), 9)
        for case, row in orders.items():
            self.assertEqual(row['expected'], 0.85)
            self.assertEqual(row['holds'], row['found'] >= 0.85)
            self.assertTrue(row['holds'], (case, row['found']))

    def test_a_bar_that_meets_a_plane_does_what_one_that_is_held_does(self):
        """The rest of its error is that of the wave."""
        restitution = self.of_case('restitution')
        for cells in (20, 40, 80, 160):
            met, held = (restitution[f'bar on plane: {choice}, {cells} along']['error'] for choice in ('plane strain', 'end held, no contact'))
            self.assertLess(abs(met - held), 0.05 * abs(held))

    def test_table_csv_and_plots(self):
        self.assertIn('| plane strain | 40 along | 160 |', self.run_.stdout)
        self.assertIn('Order in cells, plane strain:', self.run_.stdout)
        with open(os.path.join(self.directory, 'contact-exact.csv')) as file:
            lines = list(csv.DictReader(file))
        told = [row for row in self.rows if row['expected'] is not None and not row['quantity'].startswith('order of ')]
        self.assertEqual(len(lines), len(told))
        for line in lines:
            self.assertGreater(float(line['wall_time_s']), 0)
        for name in ('bar_on_plane', 'bar_on_plane_finer', 'bounce_phi_0.5', 'bounce_phi_0.5_finer'):
            with open(os.path.join(self.directory, f'contact_exact_{name}.png'), 'rb') as file:
                self.assertEqual(file.read(8), b'\x89PNG\r\n\x1a\n')

    def test_what_is_not_there(self):
        for words, said in ((['exact', 'bounces'], 'problem bounces is not one of bounce, bars'), (['shakes'], 'shakes is not one of the runs of contact'),
                            (['shaken', 'bars'], 'nothing is chosen after shaken')):
            run = run_bench('contact', *words)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(said, run.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
