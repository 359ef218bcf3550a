// What hand and eye have of a map that is being made. It comes when a map is begun.
export { MAKE } from './gestures/arms';
export { ArmsOverlay } from './overlay-arms';
