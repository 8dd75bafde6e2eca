"use strict";
// Shows one case at a time, the one that the address names, and filters the list.
(() => {
  const articles = [...document.querySelectorAll("article")];
  const items = [...document.querySelectorAll("#cases > li")];
  const words = document.getElementById("filter");
  const status = document.getElementById("status");

  const named = () => {
    const id = decodeURIComponent(location.hash.slice(1));
    return articles.find((article) => article.id === id) ?? articles[0];
  };

  const show = () => {
    const shown = named();
    for (const article of articles) article.hidden = article !== shown;
    for (const item of items) {
      const link = item.querySelector("a");
      item.classList.toggle("current", link !== null && link.hash.slice(1) === shown?.id);
    }
    document.querySelector("main").scrollTop = 0;
    const view = shown?.querySelector(".view");
    if (view) globalThis.showView(view);
  };

  const filter = () => {
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const item of items) {
      const fits = wanted.every((word) => item.dataset.words.includes(word));
      item.hidden = !fits || (status.value !== "" && item.dataset.status !== status.value);
    }
    const count = items.filter((item) => !item.hidden).length;
    document.getElementById("matching").textContent = `${count} of ${items.length}`;
  };

  words.addEventListener("input", filter);
  status.addEventListener("change", filter);
  addEventListener("hashchange", show);
  filter();
  show();
})();
