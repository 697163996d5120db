'use strict';
// Without this script the lamps share each picture half and half, and the table stands in the study's order.
for (const strip of document.querySelectorAll('.strip')) {
    const slider = strip.querySelector('input');
    const stack = strip.querySelector('.stack');
    slider.addEventListener('input', () => { stack.style.setProperty('--share', `${slider.value}%`); });
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
