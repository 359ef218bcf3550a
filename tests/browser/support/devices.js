// Page settings of touch devices.
const device = (width, height, deviceScaleFactor) => ({
  viewport: { width, height },
  deviceScaleFactor,
  isMobile: true,
  hasTouch: true,
});

export const devices = {
  phone: device(390, 844, 2),
  'phone on its side': device(844, 390, 2),
  tablet: device(820, 1180, 1),
  'tablet on its side': device(1180, 820, 1),
};
