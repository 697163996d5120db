'use strict';
// Without this script pictures are wiped half and half, tables stand in their order, all plots are shown, and what is folded stays so on paper.
for (const strip of document.querySelectorAll('.strip')) {
  const slider = strip.querySelector('input');
  const stack = strip.querySelector('.stack');
  if (slider) slider.addEventListener('input', () => { stack.style.setProperty('--share', `${slider.value}%`); });
}

for (const table of document.querySelectorAll('table.sortable')) {
  const heads = Array.from(table.tHead.rows[0].cells);
  heads.forEach((head, column) => {
    const button = head.querySelector('button');
    if (!button)
      return;
    button.addEventListener('click', () => {
      const down = head.getAttribute('aria-sort') === 'ascending';
      heads.forEach((other) => other.removeAttribute('aria-sort'));
      head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      const key = (row) => row.cells[column].dataset.key ?? row.cells[column].textContent.trim();
      const numbers = head.dataset.numbers !== undefined;
      const rows = Array.from(table.tBodies[0].rows);
      // What was not measured stays at the end either way.
      rows.sort((a, b) => {
        const x = key(a), y = key(b);
        if (x === '' || y === '')
          return (x === '') - (y === '');
        return (down ? -1 : 1) * (numbers ? Number(x) - Number(y) : x.localeCompare(y, 'en'));
      });
      table.tBodies[0].append(...rows);
    });
  });
}

// What a link leads to is shown, and paper has all.
const unfold = (element) => { for (let at = element; at; at = at.parentElement) if (at.tagName === 'DETAILS') at.open = true; };
const follow = () => { if (location.hash.length > 1) { const to = document.getElementById(location.hash.slice(1)); unfold(to); if (to) to.scrollIntoView(); } };
addEventListener('hashchange', follow);
follow();
let closed = [];
addEventListener('beforeprint', () => { closed = Array.from(document.querySelectorAll('details:not([open])')); for (const one of closed) one.open = true; });
addEventListener('afterprint', () => { for (const one of closed) one.open = false; });

// Plots of several places: which of them, which lines in them, in which order.
const placed = Array.from(document.querySelectorAll('figure[data-place]'));
if (placed.length > 2) {
  const unique = (all) => Array.from(new Set(all));
  const make = (tag, properties, ...inside) => { const one = Object.assign(document.createElement(tag), properties); one.append(...inside); return one; };
  const sections = unique(placed.map((figure) => figure.closest('section')));
  const placesOf = (figure) => figure.dataset.place.split(' | ');
  const off = { place: new Set(), line: new Set() };
  const count = make('output', {});
  let wanted = '';
  const show = () => {
    let shown = 0;
    for (const figure of placed) {
      figure.hidden = placesOf(figure).every((place) => off.place.has(place)) || !figure.dataset.place.toLowerCase().includes(wanted);
      shown += !figure.hidden;
      for (const line of figure.querySelectorAll('[data-of]'))
        line.style.display = off.line.has(line.dataset.of) ? 'none' : '';
    }
    count.textContent = `${shown} of ${placed.length} plots`;
  };
  const chips = (name, kind, all) => make('div', { className: 'chips', role: 'group', ariaLabel: name }, make('span', { textContent: name }), ...all.map((one) => {
    const chip = make('button', { type: 'button', textContent: one, ariaPressed: 'true' });
    chip.addEventListener('click', () => {
      const shown = off[kind].delete(one) || !off[kind].add(one);
      chip.ariaPressed = String(shown);
      show();
    });
    return chip;
  }));
  const places = unique(placed.flatMap(placesOf));
  const search = make('input', { type: 'search', placeholder: 'filter', ariaLabel: 'Routes whose name has' });
  search.addEventListener('input', () => { wanted = search.value.trim().toLowerCase(); show(); });
  const order = make('select', {}, ...['as played', 'by name', 'best first', 'worst first'].map((text) => make('option', { textContent: text })));
  order.addEventListener('change', () => {
    for (const section of sections) {
      const figures = placed.filter((figure) => figure.closest('section') === section);
      const rank = (figure) => Number(figure.dataset.rank);
      figures.sort(order.selectedIndex === 1 ? (a, b) => a.dataset.place.localeCompare(b.dataset.place, 'en')
        : order.selectedIndex > 1 ? (a, b) => (order.selectedIndex === 2 ? 1 : -1) * (rank(b) - rank(a)) : () => 0);
      figures[0].parentElement.append(...figures);
    }
  });
  const lines = unique(placed.flatMap((figure) => Array.from(figure.querySelectorAll('[data-of]'), (line) => line.dataset.of)));
  sections[0].querySelector('h2').after(make('div', { className: 'tools' }, places.length <= 12 ? chips('Routes', 'place', places) : search,
    chips('Lamps', 'line', lines), make('label', {}, 'Order ', order), count));
  show();
}
