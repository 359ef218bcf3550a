/** Opens the browser's own dialog for files; `take` gets what was chosen. */
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
