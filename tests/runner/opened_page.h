// A report's page in a headless Chromium: its table sorts, its slider moves, its links lead somewhere, its pictures load, nothing
// complains.
#pragma once

#include "tests/runner/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sstream>
#include <vector>

namespace fernlicht {

/// What the page said of itself: "sorted up, sorted down, the slider's share, targets of # there, pictures loaded, number of pictures", and
/// where its links to files lead.
struct OpenedPage {
    std::string said;
    std::vector<std::string> links;
};

/// Opens the report.html of `out`, a folder below `folder`, with a script added. `picture` is what each picture must meet, in JavaScript.
inline OpenedPage opened_page(const TemporaryFolder& folder, const std::string& out, const std::string& picture) {
    std::string page = content_of(folder / (out + "/report.html"));
    const std::size_t end = page.rfind("</body>");
    page.insert(end, R"(<script>
const table = document.querySelector('table.sortable'), heads = Array.from(table.tHead.rows[0].cells);
const column = heads.findIndex((head) => head.textContent === 'change');
const keys = () => Array.from(table.tBodies[0].rows, (row) => Number(row.cells[column].dataset.key));
const inOrder = (sign) => keys().every((key, i, all) => i === 0 || sign * (key - all[i - 1]) >= 0);
const button = heads[column].querySelector('button');
button.click(); const up = inOrder(1); button.click(); const down = inOrder(-1);
const slider = document.querySelector('.strip input');
slider.value = '20'; slider.dispatchEvent(new Event('input'));
const share = document.querySelector('.stack').style.getPropertyValue('--share');
const targets = Array.from(document.querySelectorAll('a[href^="#"]')).every((a) => document.getElementById(a.getAttribute('href').slice(1)));
const links = Array.from(document.querySelectorAll('a[href^="."]'), (a) => a.getAttribute('href'));
const pictures = Array.from(document.images).every((image) => image.complete && )" +
                         picture + R"();
document.title = [up, down, share, targets, pictures, document.images.length].join(' ') + '|' + links.join('|');
</script>)");
    std::ofstream(folder / (out + "/opened.html")) << page;
    const Outcome browser =
        run_shell(fmt::format("timeout 120 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr --user-data-dir={} "
                              "--dump-dom file://{}",
                              folder / "browser", folder / (out + "/opened.html")));
    EXPECT_THAT(browser.output, testing::Not(testing::HasSubstr("CONSOLE"))) << "the browser complained";
    OpenedPage opened;
    const std::size_t from = browser.output.find("<title>"), to = browser.output.find("</title>");
    if (from == std::string::npos || to == std::string::npos) {
        ADD_FAILURE() << browser.output.substr(0, 2000);
        return opened;
    }
    std::istringstream title(browser.output.substr(from + 7, to - from - 7));
    std::getline(title, opened.said, '|');
    for (std::string link; std::getline(title, link, '|');)
        opened.links.push_back(link);
    return opened;
}

} // namespace fernlicht
