// What every element of the page is made of.
import { LitElement } from "lit";

// Without a shadow root: the page's one style sheet holds within, and ids are found from outside.
export class PageElement extends LitElement {
  protected override createRenderRoot(): this {
    return this;
  }
}
