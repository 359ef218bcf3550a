// What hand and eye have of a map that is being made. It comes when a map is begun.
export { makingTool } from './arms';
export { ArmsOverlay } from './arms-overlay';
