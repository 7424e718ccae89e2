const paths = {
  dark: 'M13.5 10A6 6 0 0 1 6 2.5 6 6 0 1 0 13.5 10Z',
  light: 'M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6ZM8 1v1.5M8 13.5V15M1 8h1.5M13.5 8H15M3 3l1 1M12 12l1 1M13 3l-1 1M4 12l-1 1',
  panels: 'M2 3h12v10H2ZM10 3v10',
  flip: 'M2 6h11M10 3l3 3M14 10H3M6 13l-3-3',
  wind: 'M1.5 6.5H9A2.2 2.2 0 1 0 6.8 4.3M1.5 9.5H12a2.2 2.2 0 1 1-2.2 2.2',
  play: 'M4.5 2.5v11l9-5.5Z',
  pause: 'M5 3v10M11 3v10',
};

/** A small drawing beside or instead of a word; what it stands for is said elsewhere. */
export function Icon({ name }: { name: keyof typeof paths }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true">
      <path d={paths[name]} />
    </svg>
  );
}
