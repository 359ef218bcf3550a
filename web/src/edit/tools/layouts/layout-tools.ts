// Handles and overlay of a map being made. Loaded when a map is begun.
export { makingTool } from './arms';
export { ArmsOverlay } from './arms-overlay';
