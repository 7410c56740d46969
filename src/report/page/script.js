'use strict';
for (const scene of document.querySelectorAll('section.scene')) {
  const groups = [...scene.querySelectorAll('.tabs')].map(group => [...group.children]);
  const plots = [...scene.querySelectorAll('.plotted')];
  const pressed = groups.map(() => 0);
  groups.forEach((buttons, g) => buttons.forEach((button, k) => button.addEventListener('click', () => {
    pressed[g] = k;
    buttons.forEach((other, j) => other.setAttribute('aria-pressed', j === k));
    const shown = pressed[1] * groups[0].length + pressed[0];
    plots.forEach((plot, j) => { plot.hidden = j !== shown; });
  })));

  const table = scene.querySelector('table.runs');
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, k) => head.firstChild.addEventListener('click', () => {
    const down = head.getAttribute('aria-sort') === 'ascending';
    heads.forEach(other => other.removeAttribute('aria-sort'));
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const value = row => row.cells[k].dataset.v;
    const order = (a, b) => head.classList.contains('n')
      ? value(a) - value(b)
      : value(a).localeCompare(value(b), 'en', { numeric: true });
    body.append(...[...body.rows].sort((a, b) => (down ? -1 : 1) * order(a, b)));
  }));

  const compare = scene.querySelector('.compare');
  if (!compare) continue;
  const pictures = [...scene.querySelectorAll('.exhibit img')];
  const stage = compare.querySelector('.stage');
  const range = compare.querySelector('input');
  const shown = [compare.querySelector('.a'), compare.querySelector('.b')];
  const choices = [compare.querySelector('.left'), compare.querySelector('.right')];
  const zoom = compare.querySelector('.zoom');
  const show = () => {
    choices.forEach((choice, k) => {
      shown[k].src = pictures[choice.value].src;
      shown[k].alt = pictures[choice.value].alt;
    });
    const times = Number(zoom.value);
    stage.classList.toggle('zoomed', times > 0);
    stage.classList.toggle('pixels', times > 1);
    for (const picture of shown) picture.style.width = times ? `${times * pictures[0].naturalWidth}px` : '';
  };
  choices.forEach((choice, k) => {
    pictures.forEach((picture, j) => choice.add(new Option(picture.alt, j)));
    choice.value = Math.min(2 * k, pictures.length - 1);
    choice.addEventListener('change', show);
  });
  zoom.addEventListener('change', show);
  range.addEventListener('input', () => stage.style.setProperty('--x', `${range.value / 10}%`));
  const drag = event => {
    if (!(event.buttons & 1)) return;
    const box = stage.getBoundingClientRect();
    range.value = Math.round(1000 * (event.clientX - box.left) / box.width);
    range.dispatchEvent(new Event('input'));
  };
  stage.addEventListener('pointerdown', drag);
  stage.addEventListener('pointermove', drag);
  show();
}
