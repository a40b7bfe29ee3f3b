// The sentence behind a "?" button: one bubble for all of them, beside the one that was pressed.
import { kHelp, type Topic } from "./help";

export class HelpPopover {
  private readonly bubble = document.createElement("div");
  private root: HTMLElement | null = null;
  private owner: HTMLElement | null = null;

  /** Listens to all "?" buttons below this element. */
  listen(root: HTMLElement): void {
    this.bubble.className = "help-bubble";
    this.bubble.setAttribute("role", "tooltip");
    this.bubble.hidden = true;
    document.body.append(this.bubble);
    this.root = root;
    root.addEventListener("click", this.onClick);
    document.addEventListener("click", this.onOutside);
    document.addEventListener("keydown", this.onKey, true);
    document.addEventListener("scroll", this.close, true);
  }

  stop(): void {
    this.bubble.remove();
    this.root?.removeEventListener("click", this.onClick);
    document.removeEventListener("click", this.onOutside);
    document.removeEventListener("keydown", this.onKey, true);
    document.removeEventListener("scroll", this.close, true);
  }

  private readonly onClick = (event: Event): void => {
    const button = (event.target as HTMLElement).closest<HTMLElement>("button.help");
    if (!button) return;
    const again = button === this.owner;
    this.close();
    if (!again) this.show(button);
    event.stopPropagation();
  };

  private readonly onOutside = (): void => this.close();

  private readonly onKey = (event: KeyboardEvent): void => {
    if (event.key !== "Escape" || !this.owner) return;
    this.close();
    event.stopPropagation();
  };

  private readonly close = (): void => {
    this.bubble.hidden = true;
    this.owner = null;
  };

  private show(button: HTMLElement): void {
    this.bubble.textContent = kHelp[button.dataset["help"] as Topic] ?? "";
    this.bubble.hidden = false;
    this.owner = button;
    const at = button.getBoundingClientRect();
    const size = this.bubble.getBoundingClientRect();
    const left = Math.max(8, Math.min(at.left, window.innerWidth - size.width - 8));
    const below = at.bottom + 6;
    const top = below + size.height < window.innerHeight ? below : Math.max(8, at.top - size.height - 6);
    this.bubble.style.left = `${left}px`;
    this.bubble.style.top = `${top}px`;
  }
}
