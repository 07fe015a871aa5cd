// Formulas that are wider than a sheet of A4 are made smaller there: 718 px are between its margins, and letters have two thirds of their
// size on a screen.
window.addEventListener("beforeprint", () => {
    for (const formula of document.querySelectorAll(".formula")) {
        const width = formula.scrollWidth * 2 / 3;
        if (width > 718) formula.style.setProperty("--shrink", Math.max(0.3, 718 / width));
    }
});
