"""What every page that a benchmark writes must be."""


def assert_well_formed(test, page, sections):
    """No number is missing, there are so many sections, and the rows of every table have equally many columns."""
    test.assertNotIn("nan", page)
    test.assertEqual(page.count("\n## "), sections)
    for block in page.split("\n\n"):
        if block.startswith("| "):
            columns = {line.count("|") for line in block.splitlines()}
            test.assertEqual(len(columns), 1, block)
