/** Where the server is that the scripts came from: they lie in its folder `assets`. Empty for the page's own root. */
export const ROOT = import.meta.env?.PROD ? import.meta.url.replace(/\/assets\/[^/]*$/, '') : '';
