// Whether a media query holds, for an element that then renders another way.
import type { ReactiveController, ReactiveControllerHost } from "lit";

export const kPhone = "(max-width: 760px)"; // as the style sheets say

export class Media implements ReactiveController {
  private readonly query: MediaQueryList;

  constructor(
    host: ReactiveControllerHost,
    query: string,
    private readonly changed: () => void = () => host.requestUpdate(),
  ) {
    this.query = window.matchMedia(query);
    host.addController(this);
  }

  get matches(): boolean {
    return this.query.matches;
  }

  hostConnected(): void {
    this.query.addEventListener("change", this.changed);
  }

  hostDisconnected(): void {
    this.query.removeEventListener("change", this.changed);
  }
}
