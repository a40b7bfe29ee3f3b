#!/usr/bin/env python3
"""The variables that integrations/README.md lists for `--shard auto`: variables_test.py PARITY [unittest options...]"""
import re
import shutil

from night import INTEGRATIONS, Night, main, run

SHARDS = 3


def read_variables():
    """(name, the number of the first shard), in the page's order, which is that of their precedence."""
    text = (INTEGRATIONS / "README.md").read_text(encoding="utf-8")
    return [(name, int(first)) for name, first in re.findall(r"^\| `([A-Z_]+)` \| ([01]) \|", text, re.MULTILINE)]


class Variables(Night):
    SCENES = 3

    def setUp(self):
        super().setUp()
        self.repository = self.checkout("repository")
        run(["parity", "plan", "--suite", "ci/nightly.toml", "--shards", str(SHARDS), "-o", "night"], self.repository, self.environment)

    def missing_after(self, variables, expected=(0,)):
        """What a copy of the plan misses after the work that these variables choose."""
        night = self.repository / "copy"
        shutil.rmtree(night, ignore_errors=True)
        shutil.copytree(self.repository / "night", night)
        run(["parity", "work", night, "--shard", "auto"], self.repository, dict(self.environment, **variables), expected)
        return run(["parity", "work", night, "--missing"], self.repository, self.environment).strip()

    def test_each_chooses_its_shard_counted_as_the_page_says(self):
        variables = read_variables()
        self.assertEqual(len(variables), 8)
        for name, first in variables:
            for shard in (0, SHARDS - 1):
                with self.subTest(variable=name, shard=shard):
                    others = ",".join(str(other) for other in range(SHARDS) if other != shard)
                    self.assertEqual(self.missing_after({name: str(first + shard)}), others)

    def test_an_index_out_of_range_is_an_error_of_usage(self):
        for name, first in read_variables():
            for index in (first - 1, first + SHARDS):
                with self.subTest(variable=name, index=index):
                    self.assertEqual(self.missing_after({name: str(index)}, expected=(64,)), "0,1,2")

    def test_the_first_of_the_page_counts(self):
        variables = read_variables()
        for (name, first), (later, later_first) in zip(variables, variables[1:]):
            with self.subTest(first=name, later=later):
                self.assertEqual(self.missing_after({later: str(later_first), name: str(first + 1)}), "0,2")

    def test_without_a_variable_it_is_an_error_of_usage(self):
        self.assertEqual(self.missing_after({}, expected=(64,)), "0,1,2")


if __name__ == "__main__":
    main("__main__")
