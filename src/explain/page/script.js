'use strict';
const choose = (article, of) => {
  for (const it of article.querySelectorAll('[data-of]')) {
    if (it.matches('section')) it.hidden = it.dataset.of !== of;
    else if (it.matches('button')) it.setAttribute('aria-pressed', it.dataset.of === of);
    else it.classList.toggle('on', it.dataset.of === of);
  }
  article.dataset.shown = of;
};
for (const article of document.querySelectorAll('article')) choose(article, article.dataset.shown);
document.addEventListener('click', event => {
  const button = event.target.closest('article .tabs button');
  if (button) choose(button.closest('article'), button.dataset.of);
});
const stage = document.getElementById('stage');
if (stage) {
  const points = JSON.parse(document.getElementById('data').textContent);
  const told = document.getElementById('told'), mark = document.getElementById('mark');
  const width = +stage.dataset.width, height = +stage.dataset.height;
  const images = [...stage.querySelectorAll('img')];
  let now = -1, technique = null;
  const show = k => {
    if (!(k in points)) return;
    now = k;
    const { x, y, html } = points[k];
    const before = told.querySelector('article');
    if (before) technique = before.dataset.picked || technique;
    told.innerHTML = html;
    const article = told.querySelector('article');
    const has = technique && article.querySelector(`button[data-of="${technique}"]`);
    choose(article, has ? technique : article.dataset.shown);
    mark.hidden = false;
    mark.style.left = 100 * (x + .5) / width + '%';
    mark.style.top = 100 * (y + .5) / height + '%';
    history.replaceState(null, '', `#${x},${y}`);
  };
  const nearest = (x, y, fits) => {
    let best = -1, least = Infinity;
    points.forEach((p, k) => {
      const dx = p.x - x, dy = p.y - y, d = dx * dx + dy * dy;
      if (d < least && fits(dx, dy)) { least = d; best = k; }
    });
    return best;
  };
  stage.addEventListener('click', event => {
    const box = stage.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) / box.width * width);
    const y = Math.floor((event.clientY - box.top) / box.height * height);
    show(nearest(x, y, () => true));
  });
  const ways = {
    ArrowLeft: (dx, dy) => dx < 0 && Math.abs(dy) <= -dx, ArrowRight: (dx, dy) => dx > 0 && Math.abs(dy) <= dx,
    ArrowUp: (dx, dy) => dy < 0 && Math.abs(dx) <= -dy, ArrowDown: (dx, dy) => dy > 0 && Math.abs(dx) <= dy,
  };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = ways[event.key], count = points.length;
    if (way && (document.activeElement === stage || document.activeElement === document.body)) {
      event.preventDefault();
      const from = points[now] || points[0];
      if (from) show(nearest(from.x, from.y, way));
    } else if (event.key === 'n') show((now + 1) % count);
    else if (event.key === 'p') show((now + count - 1) % count);
  });
  told.addEventListener('click', event => {
    const button = event.target.closest('.tabs button');
    if (button) button.closest('article').dataset.picked = button.dataset.of;
  });
  document.querySelector('.picture .tabs').addEventListener('click', event => {
    const button = event.target.closest('button');
    if (!button) return;
    for (const other of button.parentNode.children) other.setAttribute('aria-pressed', other === button);
    images.forEach((image, k) => { image.hidden = k !== +button.dataset.picture; });
  });
  const place = location.hash.slice(1).split(',').map(Number);
  show(place.length === 2 && place.every(Number.isFinite) ? nearest(place[0], place[1], () => true) : 0);
}
