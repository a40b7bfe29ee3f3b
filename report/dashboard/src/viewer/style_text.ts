// Styles of elements that change with the state. Bound as `.style=${styleText({...})}`: the property goes through the
// CSSOM, while a style attribute (and lit's styleMap, which starts with one) is forbidden by the page's policy.

/** "left: 3px; top: 4px" */
export function styleText(styles: Readonly<Record<string, string>>): string {
  return Object.entries(styles)
    .map(([name, value]) => `${name}: ${value}`)
    .join("; ");
}
