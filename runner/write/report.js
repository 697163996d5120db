'use strict';
// Without this script all moments stand one below the other; with it one is shown and chosen by slider, buttons or keys.
for (const chooser of document.querySelectorAll('.chooser')) {
  const moments = Array.from(chooser.parentElement.querySelectorAll('.moment'));
  const slider = chooser.querySelector('input');
  const label = chooser.querySelector('output');
  const buttons = Array.from(chooser.querySelectorAll('button'));
  if (moments.length < 2) continue;

  const show = (index) => {
    const chosen = Math.min(Math.max(index, 0), moments.length - 1);
    moments.forEach((moment, i) => { moment.hidden = i !== chosen; });
    slider.value = String(chosen);
    slider.setAttribute('aria-valuetext', moments[chosen].dataset.label);
    label.textContent = moments[chosen].dataset.label;
    buttons[0].disabled = chosen === 0;
    buttons[1].disabled = chosen === moments.length - 1;
  };
  const step = (by) => show(Number(slider.value) + by);

  slider.addEventListener('input', () => show(Number(slider.value)));
  for (const button of buttons) button.addEventListener('click', () => step(Number(button.dataset.step)));
  chooser.parentElement.addEventListener('keydown', (event) => {
    if (event.target === slider || event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === 'ArrowLeft') step(-1);
    else if (event.key === 'ArrowRight') step(1);
    else return;
    event.preventDefault();
  });
  chooser.hidden = false;
  show(0);
}
