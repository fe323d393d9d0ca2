// Reads formulas as JSON, [{tex, display, where}], and names the first that
// MathJax does not understand: node check_formulas.cjs NODE_MODULES
const path = require("path");
const js = path.resolve(process.argv[2], "mathjax-full/js");
const { mathjax } = require(`${js}/mathjax.js`);
const { TeX } = require(`${js}/input/tex.js`);
const { AllPackages } = require(`${js}/input/tex/AllPackages.js`);
const { liteAdaptor } = require(`${js}/adaptors/liteAdaptor.js`);
const { RegisterHTMLHandler } = require(`${js}/handlers/html.js`);
const { STATE } = require(`${js}/core/MathItem.js`);

RegisterHTMLHandler(liteAdaptor());
// Without the packages that turn errors into text, and one that needs to draw.
const without = ["noerrors", "noundefined", "bussproofs"];
const tex = new TeX({
  packages: AllPackages.filter((name) => !without.includes(name)),
  formatError: (_, error) => {
    throw error;
  },
});
const page = mathjax.document("", { InputJax: tex });
for (const formula of JSON.parse(require("fs").readFileSync(0, "utf8"))) {
  try {
    page.convert(formula.tex, { display: formula.display, end: STATE.COMPILED });
  } catch (error) {
    const text = formula.tex.replace(/\s+/g, " ");
    console.log(`${formula.where}: formula ${text}: ${error.message}`);
    process.exit(1);
  }
}
