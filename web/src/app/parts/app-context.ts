// The editor's parts for every component below the root.
import { createContext } from 'preact';
import { useContext } from 'preact/hooks';
import type { Context } from '../../actions/context';

const AppContext = createContext<Context | null>(null);

export const AppProvider = AppContext.Provider;

export function useApp(): Context {
  const c = useContext(AppContext);
  if (!c) throw new Error('a component outside the editor');
  return c;
}
