// Without this script all moments stand one below the other; with it one is shown, chosen by slider, buttons, keys or in a curve, and the lux
// under the pointer is read from codes that the page holds.
const make = (tag, attributes) => {
  const one = document.createElementNS(tag === 'line' ? 'http://www.w3.org/2000/svg' : 'http://www.w3.org/1999/xhtml', tag);
  for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, value);
  return one;
};

for (const viewer of document.querySelectorAll('.viewer')) {
  const moments = Array.from(viewer.querySelectorAll('.moment'));
  const chooser = viewer.querySelector('.chooser');
  if (!chooser) continue;
  const slider = chooser.querySelector('input');
  const label = chooser.querySelector('.moment-label');
  const lux = chooser.querySelector('.lux');
  const buttons = Array.from(chooser.querySelectorAll('button'));
  const drive = viewer.closest('article');
  viewer.classList.add('live');

  // Lines across all curves over time or over the way, at the shown moment.
  const curves = [];
  for (const svg of drive.querySelectorAll('svg[data-course]')) {
    const [left, top, width, height, from, to] = svg.dataset.course.split(' ').map(Number);
    const kind = svg.dataset.along === 'time' ? 'time' : svg.dataset.along === 'distance along the route' ? 'distance' : '';
    if (!kind || !moments.every((moment) => moment.dataset[kind] !== undefined)) continue;
    const line = make('line', { class: 'cursor', y1: top, y2: top + height });
    svg.append(line);
    curves.push((moment) => {
      const x = left + width * (Number(moment.dataset[kind]) - from) / (to - from);
      line.setAttribute('x1', x); line.setAttribute('x2', x);
    });
    svg.addEventListener('click', (event) => {
      const box = svg.getBoundingClientRect();
      const at = from + (to - from) * ((event.clientX - box.left) * svg.viewBox.baseVal.width / box.width - left) / width;
      const off = moments.map((moment) => Math.abs(Number(moment.dataset[kind]) - at));
      show(off.indexOf(Math.min(...off)));
    });
  }

  let share = '50%';
  const show = (index) => {
    const chosen = Math.min(Math.max(index, 0), moments.length - 1);
    moments.forEach((moment, i) => { moment.hidden = i !== chosen; });
    for (const stack of moments[chosen].querySelectorAll('.stack')) stack.style.setProperty('--share', share);
    for (const input of moments[chosen].querySelectorAll('.wipe input')) input.value = parseInt(share, 10);
    slider.value = String(chosen);
    slider.setAttribute('aria-valuetext', moments[chosen].dataset.label);
    label.textContent = moments[chosen].dataset.label;
    lux.textContent = '';
    buttons[0].disabled = chosen === 0;
    buttons[1].disabled = chosen === moments.length - 1;
    for (const move of curves) move(moments[chosen]);
  };
  const step = (by) => show(Number(slider.value) + by);
  slider.addEventListener('input', () => show(Number(slider.value)));
  for (const button of buttons) button.addEventListener('click', () => step(Number(button.dataset.step)));
  viewer.addEventListener('keydown', (event) => {
    if (event.target.tagName === 'INPUT' || event.altKey || event.ctrlKey || event.metaKey || event.defaultPrevented) return;
    if (event.key === 'ArrowLeft') step(-1);
    else if (event.key === 'ArrowRight') step(1);
    else return;
    event.preventDefault();
  });
  for (const input of viewer.querySelectorAll('.wipe input'))
    input.addEventListener('input', () => {
      share = `${input.value}%`;
      input.closest('figure').querySelector('.stack').style.setProperty('--share', share);
    });

  // Of a code's PNG only the zlib stream is of interest: rows of red, green and blue behind a byte of 0 each.
  const pixels = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    const parts = [];
    let width = 0;
    for (let at = 8; at < bytes.length; at += 12 + view.getUint32(at)) {
      const kind = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
      if (kind === 'IHDR') width = view.getUint32(at + 8);
      if (kind === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + view.getUint32(at)));
    }
    const stream = new Blob(parts).stream().pipeThrough(new DecompressionStream('deflate'));
    const rows = new Uint8Array(await new Response(stream).arrayBuffer());
    return { width, height: rows.length / (3 * width + 1), at: (x, y, channel) => rows[y * (3 * width + 1) + 1 + 3 * x + channel] };
  };
  const words = (code) => code === 0 ? '' : code === 1 ? '< 0.05 lx' : code === 255 ? '> 500 lx' : `${Number((0.05 * 10000 ** ((code - 2) / 252)).toPrecision(3))} lx`;
  const decoded = new Map();
  // x and y from 0 to 1 within what the codes show.
  const read = async (holder, x, y) => {
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) { lux.textContent = ''; return; }
    if (!decoded.has(holder)) decoded.set(holder, pixels(holder.dataset.codes));
    const image = await decoded.get(holder);
    const names = holder.dataset.names.split('|');
    lux.textContent = names.map((name, i) => [name, words(image.at(Math.floor(x * image.width), Math.floor(y * image.height), i))])
      .filter(([, said]) => said).map((told) => told.join(' ')).join(' · ');
  };
  for (const holder of viewer.querySelectorAll('[data-codes]')) {
    const svg = holder.querySelector(':scope > svg');
    const area = () => {
      const box = (svg ?? holder).getBoundingClientRect();
      if (!svg) return box;
      // The plot's inner window is the only nested <svg>.
      const inner = svg.querySelector('svg'), scale = box.width / svg.viewBox.baseVal.width;
      const of = (name) => inner[name].baseVal.value * scale;
      return { left: box.left + of('x'), top: box.top + of('y'), width: of('width'), height: of('height') };
    };
    holder.addEventListener('pointermove', (event) => {
      const box = area();
      read(holder, (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    });
    holder.addEventListener('pointerleave', () => { lux.textContent = ''; });
    if (svg) continue;
    const cross = make('div', { class: 'cross', hidden: '' });
    holder.append(cross);
    let x = 0.5, y = 0.6;
    const place = () => { cross.style.left = `${100 * x}%`; cross.style.top = `${100 * y}%`; read(holder, x, y); };
    holder.addEventListener('focus', () => { if (holder.matches(':focus-visible')) { cross.hidden = false; place(); } });
    holder.addEventListener('blur', () => { cross.hidden = true; });
    holder.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!by || event.altKey || event.ctrlKey || event.metaKey) return;
      const far = event.shiftKey ? 0.1 : 0.01;
      x = Math.min(Math.max(x + far * by[0], 0), 0.999); y = Math.min(Math.max(y + far * by[1], 0), 0.999);
      cross.hidden = false;
      place();
      event.preventDefault();
    });
  }

  chooser.hidden = false;
  show(0);
}
