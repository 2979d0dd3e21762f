// What a person types into a field of a number: a number, with point or comma, or a sum.

/** The value of an expression of numbers with + - * / ( ); null if it is none. */
export function evaluate(text: string): number | null {
  const tokens = text.replaceAll("\u2212", "-").replace(/(\d),(\d)/g, "$1.$2").match(/\d*\.?\d+(?:[eE][+-]?\d+)?|\d+\.|[-+*/()]|\S/g);
  if (!tokens) return null;
  let at = 0;
  const sum = (): number => {
    let value = product();
    while (tokens[at] === "+" || tokens[at] === "-") value = tokens[at++] === "+" ? value + product() : value - product();
    return value;
  };
  const product = (): number => {
    let value = factor();
    while (tokens[at] === "*" || tokens[at] === "/") value = tokens[at++] === "*" ? value * factor() : value / factor();
    return value;
  };
  const factor = (): number => {
    const token = tokens[at++];
    if (token === "-") return -factor();
    if (token === "+") return factor();
    if (token === "(") {
      const value = sum();
      return tokens[at++] === ")" ? value : NaN;
    }
    return token === undefined || !/^[\d.]/.test(token) ? NaN : Number(token);
  };
  const value = sum();
  return at === tokens.length && Number.isFinite(value) ? value : null;
}
