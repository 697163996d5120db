#!/usr/bin/env python3
"""Opens the pages of runs and studies as people do: `pages_test.py OUT RUN STUDY [LARGE]`, folders of reports. Screenshots of what fails are
left in OUT."""
import base64
import json
import os
import re
import struct
import sys
import traceback
import zlib

from browser import Browser

CONTRAST = """(() => {
  const parse = (text) => { const n = text.match(/[\\d.]+/g).map(Number); return n.length < 4 ? [...n, 1] : n; };
  const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const over = (top, ground) => top.slice(0, 3).map((c, i) => c * top[3] + ground[i] * (1 - top[3]));
  const ground = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) layers.push(parse(getComputedStyle(at).backgroundColor));
    return layers.reverse().reduce((below, layer) => over(layer, below), matchMedia('(prefers-color-scheme: dark)').matches ? [18, 18, 18] : [255, 255, 255]);
  };
  const bad = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node; node = walk.nextNode();) {
    const element = node.parentElement;
    if (!node.data.trim() || element.closest('svg, script, style, button:disabled, .stack') || element.getClientRects().length === 0) continue;
    const style = getComputedStyle(element), below = ground(element), a = light(over(parse(style.color), below)), b = light(below);
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const large = parseFloat(style.fontSize) >= 24 || (parseFloat(style.fontSize) >= 18.66 && style.fontWeight >= 700);
    if (ratio < (large ? 3 : 4.5)) bad.push(`${ratio.toFixed(2)}: ${node.data.trim().slice(0, 40)} (${element.className || element.tagName})`);
  }
  return bad;
})()"""

NAMELESS = """Array.from(document.querySelectorAll('img, svg[role=img], button, input, select, [role=img]')).filter((e) =>
  !(e.alt || e.getAttribute('aria-label') || e.querySelector(':scope > title')?.textContent || e.textContent.trim() || e.closest('label') || e.tagName === 'svg' && e.closest('svg svg')))
  .map((e) => e.outerHTML.slice(0, 120))"""


def same(found, expected, what):
    if found != expected:
        raise AssertionError(f"{what}: found {found!r}, expected {expected!r}")


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def looks_well(browser, page):
    """Light, dark and on a narrow screen: no complaint, contrast as WCAG AA asks, names for what is seen or used, nothing too wide."""
    for dark in (False, True):
        browser.open(page, dark=dark)
        same(browser.run(CONTRAST), [], f"contrast, {'dark' if dark else 'light'}")
    same(browser.run(NAMELESS), [], "without a name")
    same(browser.complaints, [], "the browser complains")
    browser.open(page, width=390)
    check(browser.run("document.documentElement.scrollWidth <= 390"), "too wide for 390 pixels")
    browser.open(page, scripts=False)
    browser.ask("Emulation.setScriptExecutionDisabled", value=False)
    check(browser.run("document.body.innerText.length") > 500, "readable without scripts")


def prints(browser, page):
    browser.open(page)
    pdf = browser.pdf()
    check(pdf.startswith(b"%PDF") and len(re.findall(rb"/Type /Page\b", pdf)) >= 2, "a PDF of some pages")


def study_answers_at_once(browser, page):
    browser.open(page)
    seen = browser.run("""(() => {
        const fits = (e) => e && e.getBoundingClientRect().bottom <= innerHeight;
        const answer = document.querySelector('.answer');
        const matrix = answer.querySelector('.matrix'), long = matrix.querySelectorAll('tbody tr').length > 12;
        return [fits(answer.querySelector('h2')), long ? matrix.getBoundingClientRect().top < innerHeight / 2 : fits(matrix), answer.querySelector('figure svg').getBoundingClientRect().top < innerHeight,
                answer.querySelector('h2').textContent, answer.querySelectorAll('.matrix tbody tr').length];
    })()""")
    same(seen[:3], [True, True, True], "sentence, matrix and ranking on the first screen")
    check(re.search(r"\d", seen[3]) and seen[4] >= 2, f"by how much: {seen[3]}")


def study_filters_and_sorts(browser, page):
    browser.open(page)
    shown = "Array.from(document.querySelectorAll('figure[data-place]:not([hidden])'), (f) => f.dataset.place)"
    before = browser.run(shown)
    place = browser.run("document.querySelector('.chips button').textContent")
    browser.click(".chips button")
    same(browser.run(shown), [one for one in before if one.split(" | ") != [place]], "one route less")
    browser.run("document.querySelector('.chips button').focus()")
    browser.press(" ", 32)
    same(browser.run(shown), before, "and back, by the keyboard")
    browser.click(".chips[aria-label=Lamps] button")
    check(browser.run("Array.from(document.querySelectorAll('figure[data-place] [data-of]')).some((e) => e.style.display === 'none')"), "a lamp less")
    first = "(() => { const s = document.querySelector('figure[data-place]').closest('section'); return Array.from(s.querySelectorAll('figure[data-place]'), (f) => Number(f.dataset.rank)); })()"
    browser.run("(() => { const s = document.querySelector('.tools select'); s.selectedIndex = 2; s.dispatchEvent(new Event('change')); })()")
    ranks = browser.run(first)
    same(ranks, sorted(ranks, reverse=True), "best first")
    same(browser.complaints, [], "the browser complains")


def links_open_what_is_folded(browser, page):
    browser.open(page)
    browser.click(".matrix td a")
    check(browser.run("location.hash.length > 1 && document.getElementById(location.hash.slice(1)).getClientRects().length > 0"), "the row is shown")


def run_moves_together(browser, page):
    browser.open(page)
    state = "[document.querySelector('.moment:not([hidden])').dataset.time, document.querySelector('.cursor').getAttribute('x1'), document.querySelector('.moment-label').textContent]"
    first = browser.run(state)
    browser.run("document.querySelector('.chooser input').focus()")
    browser.press("ArrowRight", 39)
    second = browser.run(state)
    check(all(a != b for a, b in zip(first, second)), f"picture, line in the curves and words: {first} {second}")
    browser.click(".chooser [data-step='-1']")
    same(browser.run(state), first, "and back")
    left, top, width, height = browser.middle_of("svg[data-course]")[2:]
    for kind in ("mousePressed", "mouseReleased"):
        browser.mouse(kind, left + 0.97 * width, top + 0.5 * height, button="left", clickCount=1)
    check(browser.run("document.querySelectorAll('.moment')[document.querySelectorAll('.moment').length - 1].hidden === false"), "a click in a curve chooses the moment")


def run_wipes(browser, page):
    browser.open(page)
    share = "getComputedStyle(document.querySelector('.moment:not([hidden]) .stack')).getPropertyValue('--share')"
    same(browser.run(share).strip(), "50%", "at first")
    browser.run("document.querySelector('.moment:not([hidden]) .wipe input').focus()")
    for _ in range(5):
        browser.press("ArrowRight", 39)
    same(browser.run(share), "55%", "by keys")
    left, top, width, height = browser.middle_of(".wipe input")[2:]
    browser.mouse("mousePressed", left + 0.2 * width, top + 0.5 * height, button="left", clickCount=1)
    browser.mouse("mouseReleased", left + 0.2 * width, top + 0.5 * height, button="left", clickCount=1)
    check(int(browser.run(share).rstrip("%")) < 35, "by the pointer")


def codes_of(png):
    """Rows of red, green, blue of a PNG whose rows have no filter."""
    at, width, data = 8, 0, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            width = struct.unpack(">I", png[at + 8:at + 12])[0]
        if kind == b"IDAT":
            data += png[at + 8:at + 8 + length]
        at += 12 + length
    raw = zlib.decompress(data)
    return [raw[i + 1:i + 1 + 3 * width] for i in range(0, len(raw), 3 * width + 1)]


def run_reads_lux(browser, page):
    browser.open(page)
    rows = codes_of(base64.b64decode(browser.run("document.querySelector('.moment:not([hidden]) .stack').dataset.codes")))
    left, top, width, height = browser.middle_of(".moment:not([hidden]) .stack")[2:]
    for share_x, share_y in ((0.5, 0.8), (0.4, 0.6), (0.6, 0.7)):
        browser.mouse("mouseMoved", left + share_x * width, top + share_y * height)
        text = browser.run("new Promise((r) => setTimeout(() => r(document.querySelector('.lux').textContent), 100))")
        # The pointer stands on whole pixels of the screen, so a neighbour may be meant.
        y, x = int(share_y * len(rows)), int(share_x * len(rows[0]) / 3)
        near = [rows[y + dy][3 * (x + dx):] for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
        for lamp, found in enumerate(re.findall(r"(< 0\.05|[\d.]+) lx", text)):
            codes = {pixel[lamp] for pixel in near}
            check(any(found == "< 0.05" if code == 1 else found != "< 0.05" and abs(float(found) / (0.05 * 10000 ** ((code - 2) / 252)) - 1) < 0.01
                      for code in codes), f"{text} at {share_x}, {share_y}: codes {codes}")
        check(" lx" in text, "something is read")
    browser.run("document.querySelector('.moment:not([hidden]) .stack').focus()")
    before = browser.run("document.querySelector('.moment-label').textContent")
    browser.press("ArrowDown", 40, shift=True)
    check(" lx" in browser.run("new Promise((r) => setTimeout(() => r(document.querySelector('.lux').textContent), 100))"), "by keys")
    same(browser.run("document.querySelector('.moment-label').textContent"), before, "the moment stays")


def paints_soon(browser, page):
    browser.open(page)
    paint = browser.run("new Promise((r) => setTimeout(() => r(performance.getEntriesByName('first-contentful-paint')[0]?.startTime), 500))")
    print(f"    {os.path.getsize(page) / 1e6:.1f} MB, first paint after {paint:.0f} ms")
    check(paint, "something is painted")


def main():
    out, run, study, large = (sys.argv[1:] + [None])[:4]
    run, study = run + "/report.html", study + "/report.html"
    cases = [(looks_well, run), (prints, run), (run_moves_together, run), (run_wipes, run), (run_reads_lux, run), (looks_well, study), (prints, study),
             (study_answers_at_once, study), (study_filters_and_sorts, study), (links_open_what_is_folded, study), (paints_soon, run), (paints_soon, study)]
    if large:
        cases += [(paints_soon, large + "/report.html"), (study_answers_at_once, large + "/report.html")]
    browser, failed = Browser(os.environ.get("CHROMIUM", "chromium")), 0
    for case, page in cases:
        name = f"{case.__name__} {os.path.basename(os.path.dirname(os.path.abspath(page)))}"
        try:
            case(browser, page)
            print(f"passed {name}")
        except (AssertionError, RuntimeError, TimeoutError, TypeError) as error:
            failed += 1
            picture = os.path.join(out, name.replace(" ", "-") + ".png")
            browser.screenshot(picture)
            print(f"FAILED {name}: {error or traceback.format_exc()}\n    {picture}")
    browser.close()
    print(f"{len(cases) - failed} of {len(cases)} passed")
    return 1 if failed else 0


sys.exit(main())
