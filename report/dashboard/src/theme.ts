// Dark or light: as the system says, or as the reader chose.
import { html, type TemplateResult } from "lit";

export type Choice = "auto" | "dark" | "light";
const kKey = "parity-theme";
const kChoices: readonly Choice[] = ["auto", "dark", "light"];

export class Theme {
  choice: Choice = "auto";

  constructor(private readonly changed: () => void) {
    try {
      const kept = localStorage.getItem(kKey);
      this.choice = kChoices.find((each) => each === kept) ?? "auto";
    } catch {
      // A sandboxed frame keeps nothing.
    }
    this.apply();
  }

  next(): void {
    this.choice = kChoices[(kChoices.indexOf(this.choice) + 1) % kChoices.length] ?? "auto";
    try {
      localStorage.setItem(kKey, this.choice);
    } catch {
      // as above
    }
    this.apply();
    this.changed();
  }

  private apply(): void {
    if (this.choice === "auto") delete document.documentElement.dataset["theme"];
    else document.documentElement.dataset["theme"] = this.choice;
  }
}

export function themeButton(theme: Theme): TemplateResult {
  return html`<button type="button" @click=${() => theme.next()} aria-label=${`Colours: ${theme.choice}. Change`}>
    ${theme.choice === "dark" ? "☾" : theme.choice === "light" ? "☀" : "◐"}<span class="word"> ${theme.choice}</span>
  </button>`;
}
