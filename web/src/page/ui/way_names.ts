import type { OtherWay } from '../../model/comparison';

export const wayNames: Record<OtherWay, string> = {
  voxels: 'voxels',
  cubes: 'marching cubes',
  coarser: 'coarser cut-cells',
  finer: 'finer cut-cells',
};
