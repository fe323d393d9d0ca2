// Renders the formulas of a page as SVG, so that pages need no script for them:
// node formulas.cjs NODE_MODULES < [{page, formulas: [{tex, display}]}]
// Prints {pages: [{defs, formulas: [html]}], css}. The glyphs of a page are
// drawn once, in `defs`.
const path = require("path");
const js = path.resolve(process.argv[2], "mathjax-full/js");
const { mathjax } = require(`${js}/mathjax.js`);
const { TeX } = require(`${js}/input/tex.js`);
const { SVG } = require(`${js}/output/svg.js`);
const { AllPackages } = require(`${js}/input/tex/AllPackages.js`);
const { liteAdaptor } = require(`${js}/adaptors/liteAdaptor.js`);
const { RegisterHTMLHandler } = require(`${js}/handlers/html.js`);
const { AssistiveMmlHandler } = require(`${js}/a11y/assistive-mml.js`);

const adaptor = liteAdaptor();
AssistiveMmlHandler(RegisterHTMLHandler(adaptor));
let css = "";

function set({ formulas }) {
  const output = new SVG({ fontCache: "global" });
  const tex = new TeX({ packages: AllPackages.filter((name) => name !== "bussproofs") });
  const page = mathjax.document("", { InputJax: tex, OutputJax: output });
  const html = formulas.map(({ tex, display }) =>
    adaptor.outerHTML(page.convert(tex, { display, em: 16, ex: 8, containerWidth: 80 * 16 })));
  css = adaptor.textContent(output.styleSheet(page));
  return { defs: adaptor.outerHTML(output.pageElements(page)), formulas: html };
}

const pages = JSON.parse(require("fs").readFileSync(0, "utf8")).map(set);
console.log(JSON.stringify({ pages, css }));
