import { computed, signal } from '@preact/signals';
import type { CellCard, Model } from '../model/cut_model';
import type { MeshInfo } from '../model/engine';
import type { PageError } from '../model/failure';
import type { Crossings, Instead, StepPicture } from '../model/instead';
import { defaultSettings } from '../model/settings';
import type { AxesSeen } from '../model/view';
import type { Play, Playing } from '../model/plays';
import { Sections } from './sections';
import type { Checks } from '../model/checks';
import type { Comparison } from '../model/comparison';
import type { Measurement } from '../model/measurement';
import type { SmokeNumbers, Wind } from '../model/wind';

/** What an alert is about: the mesh and its cut, the picture as such, or an answer to something else that was asked. */
export type About = 'mesh' | 'picture' | 'answer';

/** What is said on top of the picture: an alert stays until it is dismissed or cleared, a notice goes away by itself. */
export interface Message {
  id: number;
  kind: 'alert' | 'notice';
  about?: About;
  /** Of an alert. */
  title?: string;
  detail: string;
}

const mostMessages = 3;

/** The state of the page. App writes it; a component that reads a signal is drawn again when that changes. */
export class State {
  readonly settings = signal(defaultSettings());
  /** The mesh to cut from now on. */
  readonly mesh = signal<MeshInfo | null>(null);
  /** Null once a mesh could not be cut: no picture is better than that of the previous mesh. */
  readonly model = signal<Model | null>(null);
  readonly status = signal<'busy' | 'ready' | 'error'>('busy');
  /** What the page is doing. */
  readonly work = signal<'loading' | 'cutting' | null>(null);
  readonly progress = signal<{ stage: string; fraction: number } | null>(null);
  readonly cutError = signal<PageError | null>(null);
  /** The cut-cell under the pointer. */
  readonly hovered = signal<number | null>(null);
  readonly pinned = signal<CellCard | null>(null);
  /** Null where nothing is measured. */
  readonly measurement = signal<Measurement | null>(null);
  /** What is drawn instead of the model: a step of the algorithm, or where the surface meets itself. */
  readonly instead = signal<Instead | null>(null);
  readonly step = computed((): StepPicture | null => (this.instead.value?.kind === 'crossings' ? null : this.instead.value));
  readonly crossings = computed((): Crossings | null => (this.instead.value?.kind === 'crossings' ? this.instead.value : null));
  /** What is to move by itself. */
  readonly play = signal<Play>('wave');
  /** What moves by itself now. */
  readonly playing = signal<Playing | null>(null);
  /** The flow that is drawn. */
  readonly wind = signal<Wind | null>(null);
  /** Of the smoke that is drawn. */
  readonly smoke = signal<SmokeNumbers | null>(null);
  /** Whether a flow or smoke is on its way. */
  readonly isWindAwaited = signal(false);
  /** What is inside in other ways, of the newest cut or the one before it. */
  readonly comparison = signal<Comparison | null>(null);
  readonly isComparisonAwaited = signal(false);
  /** The same, where the picture is divided: not where something else is drawn instead of the model. */
  readonly divided = computed((): Comparison | null => {
    const { way } = this.settings.value.compare;
    const comparison = this.comparison.value;
    if (way === 'none' || !comparison?.ways[way]) return null;
    return this.instead.value || this.wind.value?.surface ? null : comparison;
  });
  /** What the checks of a model, by its id, have found; of the last one that was checked. */
  readonly checked = signal<{ model: number; checks: Checks } | null>(null);
  /** Null before the first picture. */
  readonly axesSeen = signal<AxesSeen | null>(null);
  /** Whether a button of the mouse, a finger or a pen is held down. */
  readonly isHeld = signal(false);
  /** Which pictures of the gallery may be loaded. */
  readonly thumbnails = signal<'none' | 'seen' | 'all'>('none');
  readonly sections = new Sections();
  /** The newest first. */
  readonly messages = signal<readonly Message[]>([]);
  private said = 0;

  /** Gives what dismisses it. */
  alert({ title, detail }: PageError, about: About = 'answer'): number {
    return this.say({ kind: 'alert', about, title, detail });
  }

  notice(detail: string): void {
    const id = this.say({ kind: 'notice', detail });
    setTimeout(() => this.dismiss(id), 6000);
  }

  dismiss(id: number): void {
    this.messages.value = this.messages.value.filter((message) => message.id !== id);
  }

  /** Something has succeeded since, so that earlier alerts about the like are old news. */
  clearAlerts(...abouts: About[]): void {
    this.messages.value = this.messages.value.filter(({ about }) => !about || !abouts.includes(about));
  }

  private say(message: Omit<Message, 'id'>): number {
    const id = ++this.said;
    this.messages.value = [{ ...message, id }, ...this.messages.value].slice(0, mostMessages);
    return id;
  }
}
