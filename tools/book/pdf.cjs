// Prints a page to a PDF with an outline and page numbers: node pdf.cjs PAGE TARGET.
const { pathToFileURL } = require("node:url");
const { launch } = require("../../tests/site/browser.cjs");

(async () => {
  const [page, target] = process.argv.slice(2);
  const browser = await launch();
  const tab = await browser.newPage();
  await tab.goto(pathToFileURL(page).href, { waitUntil: "load" });
  await tab.evaluate(() => Promise.all([document.fonts.ready, ...[...document.images].map((image) => image.decode())]));
  await tab.pdf({
    path: target,
    preferCSSPageSize: true,
    outline: true,
    tagged: true,
    printBackground: true,
    displayHeaderFooter: true,
    headerTemplate: "<span></span>",
    footerTemplate: '<div style="width: 100%; font-size: 8px; text-align: center"><span class="pageNumber"></span></div>',
  });
  await browser.close();
})();
