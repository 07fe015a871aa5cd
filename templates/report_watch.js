// Loads the page anew when the program has made the next one. Before this stands `watched_version`.
(async () => {
    for (;;) {
        try {
            const answer = await fetch(`/next?${watched_version}`);
            if (answer.ok && Number(await answer.text()) !== watched_version) return location.reload();
        } catch (e) {  // the program has ended, or is not there yet
        }
        await new Promise((resolve) => setTimeout(resolve, 1000));
    }
})();
