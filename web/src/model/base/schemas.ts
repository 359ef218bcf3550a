// Documents of the server by the names of its OpenAPI document.
import type { components } from './api';

export type Schemas = components['schemas'];
