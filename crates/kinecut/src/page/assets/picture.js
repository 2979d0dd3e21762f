"use strict";
// Plays the motion of pictures: `data-way` of an svg holds "x y t" of the moving circle, `data-t` of a path the time from
// which it is shown. In a job's report `data-program` holds the program's time at 0 and its whole time: there the page's
// slider is the one time, this picture follows it and moves it.
(() => {
  const slow = matchMedia("(prefers-reduced-motion: reduce)");
  const pageTime = document.getElementById("kc-time");
  const pageClock = document.getElementById("kc-clock");
  for (const svg of document.querySelectorAll("svg[data-way]")) {
    const way = svg.dataset.way.split(" ").map(Number);
    const count = Math.floor(way.length / 3);
    const bar = svg.parentElement.querySelector(".p-player");
    if (count < 2 || !bar) continue;
    const [play, slider, clock] = ["button", "input", "output"].map((tag) => bar.querySelector(tag));
    const mover = svg.querySelector(".p-mover");
    const standing = [...svg.querySelectorAll(":scope > .k-glass")];
    const parts = [...svg.querySelectorAll("[data-t]")].map((path) => ({ path, t: Number(path.dataset.t) }));
    const first = way[2];
    const last = way[3 * count - 1];
    const program = svg.dataset.program && pageTime && pageClock ? svg.dataset.program.split(" ").map(Number) : null;
    let now = last;
    let frame = 0;

    const show = (t, complete) => {
      now = Math.min(last, Math.max(first, t));
      let i = 1;
      while (i < count - 1 && way[3 * i + 2] < now) i++;
      const [x0, y0, t0, x1, y1, t1] = way.slice(3 * i - 3, 3 * i + 3);
      const share = t1 > t0 ? Math.min(1, Math.max(0, (now - t0) / (t1 - t0))) : 1;
      mover.setAttribute("transform", `translate(${x0 + share * (x1 - x0)} ${y0 + share * (y1 - y0)})`);
      mover.setAttribute("visibility", complete ? "hidden" : "visible");
      for (const cutter of standing) cutter.setAttribute("visibility", complete ? "visible" : "hidden");
      for (const { path, t: from } of parts) {
        path.setAttribute("visibility", complete || from <= now ? "visible" : "hidden");
      }
      slider.value = String(Math.round(((now - first) / (last - first)) * 1000));
      clock.textContent = `${(now - first).toFixed(1)} of ${(last - first).toFixed(1)} s`;
    };
    const stop = () => {
      cancelAnimationFrame(frame);
      frame = 0;
      play.textContent = "▶";
      play.setAttribute("aria-label", "Play");
    };
    const go = (t) => {
      if (!program) return show(t, false);
      pageTime.value = String(((program[0] + t) / program[1]) * Number(pageTime.max));
      pageTime.dispatchEvent(new Event("input"));
      show(t, false);
    };
    slider.addEventListener("input", () => {
      stop();
      go(first + (Number(slider.value) / 1000) * (last - first));
    });
    play.addEventListener("click", () => {
      if (frame) return stop();
      // A pass is shown in eight seconds whatever it takes on the machine.
      const rate = (last - first) / 8;
      let t = now >= last ? first : now;
      let before = performance.now();
      play.textContent = "❚❚";
      play.setAttribute("aria-label", "Stop");
      const step = (at) => {
        t += ((at - before) / 1000) * rate;
        before = at;
        go(t);
        if (t >= last) stop();
        else frame = requestAnimationFrame(step);
      };
      frame = requestAnimationFrame(step);
    });
    if (program) {
      new MutationObserver(() => {
        if (frame) return;
        const place = Number(pageTime.value);
        // Before the first move of the page's cursor the picture stands complete.
        if (place === 0) show(last, true);
        else show((place / Number(pageTime.max)) * program[1] - program[0], false);
      }).observe(pageClock, { childList: true, characterData: true, subtree: true });
    }
    const motion = () => {
      play.hidden = slow.matches;
      if (slow.matches) stop();
    };
    slow.addEventListener("change", motion);
    motion();
    show(last, true);
    bar.classList.add("live");
  }
})();
