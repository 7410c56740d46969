'use strict';
for (const viewer of document.querySelectorAll('.viewer')) {
  const stage = viewer.querySelector('.stage');
  const slide = viewer.querySelector('input[type=range]');
  const box = viewer.querySelector('.box');
  const size = viewer.querySelector('select');
  const set = (element, name, value) => element.style.setProperty(name, value);
  const split = () => set(stage, '--split', slide.value + '%');
  slide.addEventListener('input', split);
  size.addEventListener('change', () => set(viewer, '--s', size.value));
  for (const view of viewer.querySelectorAll('input[type=radio]')) {
    const show = () => { if (view.checked) viewer.dataset.view = view.value; };
    view.addEventListener('change', show);
    show();
  }
  split();
  set(viewer, '--s', size.value);
  stage.addEventListener('pointermove', event => {
    if (event.buttons === 0 || viewer.dataset.view !== 'split') return;
    const { left, width } = stage.getBoundingClientRect();
    slide.value = 100 * (event.clientX - left) / width;
    split();
  });
  const section = viewer.closest('section');
  for (const cut of section.querySelectorAll('.cut')) {
    const source = viewer.querySelector('img.' + cut.dataset.of).src;
    const { style } = viewer;
    cut.style.backgroundImage = `url(${source})`;
    cut.style.backgroundSize = `${8 * style.getPropertyValue('--w')}px ${8 * style.getPropertyValue('--h')}px`;
  }
  for (const button of section.querySelectorAll('[data-window]')) {
    button.addEventListener('click', () => {
      const [x, y, width, height] = button.dataset.window.split(',');
      set(box, '--bx', x);
      set(box, '--by', y);
      set(box, '--bw', width);
      set(box, '--bh', height);
      box.hidden = false;
      box.scrollIntoView({ block: 'center', inline: 'center' });
    });
  }
}
