/** Opens the browser's file dialog; `take` gets the chosen files. */
export function fileChooser(take: (files: File[]) => void): () => void {
  const input = document.createElement('input');
  input.type = 'file';
  input.multiple = true;
  input.className = 'sr';
  input.tabIndex = -1;
  input.setAttribute('aria-hidden', 'true');
  input.addEventListener('change', () => {
    take([...(input.files ?? [])]);
    input.value = '';
  });
  document.body.append(input);
  return () => input.click();
}
