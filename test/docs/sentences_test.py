# SPDX-License-Identifier: BSD-3-Clause
"""Plain English: no sentence of the pages is longer than 40 words. The aim is 25; what is above it is counted and printed."""

import unittest

from sentences import sentences_of, words_in
from sources import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "benchmark").glob("*.md"))]
MOST_WORDS = 40
AIM_WORDS = 25


class SentencesTest(unittest.TestCase):
    def test_what_counts_as_a_sentence(self):
        page = "# A title\nOne `a. B` two\nthree. Four (five. Six)\n\n```\nnot. This\n```\n| nor. This |\n- an item. Of two\n- [a link](to/a. B)\n"
        self.assertEqual([words_in(sentence) for sentence in sentences_of(page)], [4, 2, 1, 2, 2, 2])

    def test_no_sentence_is_longer_than_the_limit(self):
        self.assertGreater(len(PAGES), 20)
        long = []
        for page in PAGES:
            counts = []
            for sentence in sentences_of(page.read_text(encoding="utf-8")):
                counts.append(words_in(sentence))
                if counts[-1] > MOST_WORDS:
                    long.append(f"{page.relative_to(ROOT)}: {counts[-1]} words: {sentence}")
            above = sum(count > AIM_WORDS for count in counts)
            print(f"{page.relative_to(ROOT)}: {len(counts)} sentences, {above} above {AIM_WORDS} words, longest {max(counts)}")
        self.assertEqual(long, [], "split these:\n" + "\n".join(long))


if __name__ == "__main__":
    unittest.main()
